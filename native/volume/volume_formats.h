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
LoadedVolume readNrrd(const VolumeRequest&);
LoadedVolume readMetaImage(const VolumeRequest&);
LoadedVolume readNifti(const VolumeRequest&);
LoadedVolume readTiff(const VolumeRequest&);  // an image if the file has one page
LoadedVolume readPng(const VolumeRequest&);
LoadedVolume readJpeg(const VolumeRequest&);
/// A grey image from any ITK reader: colours become luminance, 8-bit samples become 0 … 1.
LoadedVolume pictureFrom(itk::ImageIOBase&, const std::string& path);
/// Whether it is a slice of a stack by its extension.
bool isPicture(const std::string& path);
/// The pictures of a folder as slices, in the natural order of the numbers in their names.
LoadedVolume readPictureStack(const VolumeRequest&);
LoadedVolume readDicomFile(const VolumeRequest&);
/// The chosen series of a folder.
LoadedVolume readDicomSeries(const VolumeRequest&);
LoadedVolume readVtkImage(const VolumeRequest&);

}  // namespace isostar::native
