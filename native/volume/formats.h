#pragma once

#include <string>
#include <vector>

#include "volume/loaded_volume.h"
#include "volume/read_volume.h"

namespace itk {
class ImageIOBase;
}

// One reader a format, chosen by readVolume(). All fail with one line.
namespace isostar::native {

LoadedVolume readRaw(const VolumeRequest&);
LoadedVolume readNrrd(const std::string& path);
LoadedVolume readMetaImage(const std::string& path);
LoadedVolume readNifti(const std::string& path);
LoadedVolume readTiff(const std::string& path);  // a picture where it has one page
LoadedVolume readPng(const std::string& path);
LoadedVolume readJpeg(const std::string& path);
/// Grey, from any ITK reader of pictures: colours become their luminance, samples of 8 bits 0 … 1.
LoadedVolume pictureFrom(itk::ImageIOBase&, const std::string& path);
LoadedVolume readTiffStack(const std::string& folder, const std::vector<std::string>& paths);
LoadedVolume readDicomFile(const std::string& path);
LoadedVolume readDicomSeries(const std::string& folder, const std::vector<std::string>& paths);
LoadedVolume readVtkImage(const std::string& path);

}  // namespace isostar::native
