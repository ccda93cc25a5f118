#include "volume/volume_reader.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "files/child_process.h"
#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/named_files.h"
#include "volume/volume_formats.h"

namespace isostar::native {
namespace {

bool isTiff(const std::string& path) {
  return extensionOf(path) == ".tif" || extensionOf(path) == ".tiff";
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
    throw Failure(
        path,
        "has an unknown extension; known are .nrrd .nhdr .mha .mhd .nii .hdr .img, the "
        "last three also with .gz, .tif .tiff .png .jpg .jpeg .dcm .ima .vti .vtk, meshes "
        "as .ply .obj .stl .glb, tetrahedra as .vtu .vtk, a folder of DICOM or TIFF "
        "slices, and raw samples with --size and --type");
  return reader->second(path);
}

LoadedVolume readAny(const VolumeRequest& request) {
  if (request.size && request.type) return readRaw(request);
  const auto read = [&] {
    return std::filesystem::is_directory(request.path) ? readFolder(request.path)
                                                       : readByExtension(request.path);
  };
  requireRegularFiles(request.path);
  using V = LoadedVolume;
  return readInChild(request.path, limitsFor(bytesReadWith(request.path)), read, &V::remarks,
                     &V::dimension, &V::size, &V::frames, &V::placement, &V::samples);
}

}  // namespace

LoadedVolume readVolume(const VolumeRequest& request) {
  LoadedVolume volume = readAny(request);
  if (request.spacing) volume.placement.spacing = *request.spacing;
  return volume;
}

}  // namespace isostar::native
