#pragma once

#include <string>
#include <vector>

#include "volume/loaded_volume.h"
#include "volume/volume_reader.h"

namespace itk {
class ImageIOBase;
}

// One reader for each format, chosen by readVolume(). All throw a Failure on damaged files.
namespace isostar::native {

LoadedVolume readRaw(const VolumeRequest&);
LoadedVolume readNrrd(const std::string& path);
LoadedVolume readMetaImage(const std::string& path);
LoadedVolume readNifti(const std::string& path);
LoadedVolume readTiff(const std::string& path);  // an image if the file has one page
LoadedVolume readPng(const std::string& path);
LoadedVolume readJpeg(const std::string& path);
/// A grey image from any ITK reader: colours become luminance, 8-bit samples become 0 … 1.
LoadedVolume pictureFrom(itk::ImageIOBase&, const std::string& path);
LoadedVolume readTiffStack(const std::string& folder, const std::vector<std::string>& paths);
LoadedVolume readDicomFile(const std::string& path);
LoadedVolume readDicomSeries(const std::string& folder, const std::vector<std::string>& paths);
LoadedVolume readVtkImage(const std::string& path);

}  // namespace isostar::native
