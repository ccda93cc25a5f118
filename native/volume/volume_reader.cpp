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

/// A reader with what it is called and the options that it understands.
struct Format {
  const char* name;
  LoadedVolume (*read)(const VolumeRequest&);
  unsigned options = 0;
};

const std::map<std::string, Format>& formats() {
  static const Format kNrrd{"NRRD", readNrrd, kFrame | kLayer},
      kMetaImage{"MetaImage", readMetaImage, kFrame}, kNifti{"NIfTI", readNifti, kFrame},
      kTiff{"TIFF", readTiff, kFrame | kChannel}, kPng{"a PNG image", readPng},
      kJpeg{"a JPEG image", readJpeg}, kDicom{"DICOM", readDicomFile, kSeries},
      kVtk{"a VTK image", readVtkImage, kScalar | kComponent};
  static const std::map<std::string, Format> kFormats = {
      {".nrrd", kNrrd},    {".nhdr", kNrrd},    {".mha", kMetaImage}, {".mhd", kMetaImage},
      {".nii", kNifti},    {".nii.gz", kNifti}, {".hdr", kNifti},     {".img", kNifti},
      {".hdr.gz", kNifti}, {".img.gz", kNifti}, {".tif", kTiff},      {".tiff", kTiff},
      {".png", kPng},      {".jpg", kJpeg},     {".jpeg", kJpeg},     {".dcm", kDicom},
      {".ima", kDicom},    {".vti", kVtk},      {".vtk", kVtk},
  };
  return kFormats;
}

/// A folder is a stack of pictures if it contains any, else DICOM.
Format formatOfFolder(const std::string& folder) {
  const std::vector<std::string> paths = filesIn(folder);
  if (std::any_of(paths.begin(), paths.end(), isPicture))
    return {"a stack of slices", readPictureStack, kChannel};
  return {"DICOM", readDicomSeries, kSeries};
}

Format formatOf(const VolumeRequest& request) {
  const std::string& path = request.path;
  if (request.size && request.type) return {"raw samples", readRaw};
  if (std::filesystem::is_directory(path)) return formatOfFolder(path);
  fileSize(path);
  const auto format = formats().find(extensionOf(path));
  if (format == formats().end())
    throw Failure(
        path,
        "has an unknown extension; known are .nrrd .nhdr .mha .mhd .nii .hdr .img, the "
        "last three also with .gz, .tif .tiff .png .jpg .jpeg .dcm .ima .vti .vtk, meshes "
        "as .ply .obj .stl .glb, tetrahedra as .vtu .vtk, a folder of DICOM or TIFF "
        "slices, and raw samples with --size and --type");
  return format->second;
}

LoadedVolume readAny(const VolumeRequest& request) {
  const Format format = formatOf(request);
  requireUnderstood(request.path, request.choices, format.name, format.options);
  const auto read = [&] {
    LoadedVolume volume = format.read(request);
    if (volume.kind.empty()) volume.kind = format.name;
    return volume;
  };
  requireRegularFiles(request.path);
  using V = LoadedVolume;
  return readInChild(request.path, limitsFor(bytesReadWith(request.path)), read, &V::remarks,
                     &V::kind, &V::type, &V::parts, &V::dimension, &V::size, &V::frames,
                     &V::placement, &V::samples);
}

}  // namespace

LoadedVolume readVolume(const VolumeRequest& request) {
  LoadedVolume volume = readAny(request);
  if (request.spacing) volume.placement.spacing = *request.spacing;
  return volume;
}

}  // namespace isostar::native
