#include "volume/volume_reader.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "files/child_process.h"
#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/volume_formats.h"

namespace isostar::native {
namespace {

bool isTiff(const std::string& path) {
  return extensionOf(path) == ".tif" || extensionOf(path) == ".tiff";
}

std::vector<std::string> filesIn(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename().string()[0] != '.')
      paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// A folder is a stack of TIFF slices if it contains any, else a DICOM series.
LoadedVolume readFolder(const std::string& folder) {
  const std::vector<std::string> paths = filesIn(folder);
  std::vector<std::string> slices;
  std::copy_if(paths.begin(), paths.end(), std::back_inserter(slices), isTiff);
  return slices.empty() ? readDicomSeries(folder, paths) : readTiffStack(folder, slices);
}

LoadedVolume readByExtension(const std::string& path) {
  using Reader = LoadedVolume (*)(const std::string&);
  static const std::map<std::string, Reader> kReaders = {
      {".nrrd", readNrrd},     {".nhdr", readNrrd},     {".mha", readMetaImage},
      {".mhd", readMetaImage}, {".nii", readNifti},     {".nii.gz", readNifti},
      {".hdr", readNifti},     {".img", readNifti},     {".hdr.gz", readNifti},
      {".img.gz", readNifti},  {".tif", readTiff},      {".tiff", readTiff},
      {".png", readPng},       {".jpg", readJpeg},      {".jpeg", readJpeg},
      {".dcm", readDicomFile}, {".ima", readDicomFile}, {".vti", readVtkImage},
      {".vtk", readVtkImage},
  };
  fileSize(path);
  const auto reader = kReaders.find(extensionOf(path));
  if (reader == kReaders.end())
    throw Failure(path,
                  "has an unknown extension; known are .nrrd .nhdr .mha .mhd .nii .nii.gz .hdr "
                  ".tif .png .jpg .dcm .vti .vtk, a folder of DICOM or TIFF slices, and raw "
                  "samples with --size and --type");
  return reader->second(path);
}

LoadedVolume readAny(const VolumeRequest& request) {
  if (request.size && request.type) return readRaw(request);
  const auto read = [&] {
    return std::filesystem::is_directory(request.path) ? readFolder(request.path)
                                                       : readByExtension(request.path);
  };
  using V = LoadedVolume;
  return readInChild(request.path, read, &V::remarks, &V::dimension, &V::size, &V::frames,
                     &V::placement, &V::samples);
}

}  // namespace

LoadedVolume readVolume(const VolumeRequest& request) {
  LoadedVolume volume = readAny(request);
  if (request.spacing) volume.placement.spacing = *request.spacing;
  return volume;
}

}  // namespace isostar::native
