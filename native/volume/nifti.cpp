// NIfTI, read by nifti_clib. ITK 5.2 rejects every affine that is not orthonormal to the last
// digits, and its reader replaces NaN by zero. The library below it does neither if its image
// loader is not used.
#include <nifti1_io.h>
#include <algorithm>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>

#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/chosen_frame.h"
#include "volume/itk_image.h"
#include "volume/placement.h"
#include "volume/volume_formats.h"

namespace isostar::native {
namespace {

constexpr double kNoticeableShear = 0.01;  // degrees; above the rounding of a float header

using Header = std::unique_ptr<nifti_image, decltype(&nifti_image_free)>;

Header openHeader(const std::string& path) {
  nifti_set_debug_level(0);
  fileSize(path);
  Header header(nifti_image_read(path.c_str(), 0), nifti_image_free);
  if (!header) throw Failure(path, "is not a NIfTI file, or its header is damaged");
  return header;
}

SampleType sampleType(const nifti_image& header, const std::string& path) {
  switch (header.datatype) {
    case DT_UINT8:
      return SampleType::U8;
    case DT_INT8:
      return SampleType::I8;
    case DT_UINT16:
      return SampleType::U16;
    case DT_INT16:
      return SampleType::I16;
    case DT_UINT32:
      return SampleType::U32;
    case DT_INT32:
      return SampleType::I32;
    case DT_UINT64:
      return SampleType::U64;
    case DT_INT64:
      return SampleType::I64;
    case DT_FLOAT32:
      return SampleType::F32;
    case DT_FLOAT64:
      return SampleType::F64;
    default:
      throw Failure(path, text("has samples of type %s; one real number is needed",
                               nifti_datatype_string(header.datatype)));
  }
}

ClaimedSize sizeOf(const nifti_image& header, const std::string& path) {
  const int sizes[] = {header.nx, header.ny, header.nz, header.nt, header.nu, header.nv, header.nw};
  for (int axis = 4; axis < header.ndim; ++axis) {
    if (sizes[axis] > 1)
      throw Failure(path, text("has %d dimensions; at most four are read, the fourth being time",
                               header.ndim));
  }
  ClaimedSize size{1, 1, 1};
  for (int axis = 0; axis < std::min(3, header.ndim); ++axis) size[axis] = sizes[axis];
  return size;
}

double millimetres(const nifti_image& header) {
  switch (header.xyz_units) {
    case NIFTI_UNITS_METER:
      return 1000;
    case NIFTI_UNITS_MICRON:
      return 0.001;
    default:
      return 1;
  }
}

/// From the sform if the file has one, else the qform, else the spacing. NIfTI's RAS becomes LPS.
Placement placementIn(const nifti_image& header, const std::string& path) {
  const mat44& affine = header.sform_code > 0 ? header.sto_xyz : header.qto_xyz;
  std::array<double, 3> origin{};
  AxisSteps steps{};
  for (int row = 0; row < 3; ++row) {
    const double scale = (row < 2 ? -1 : 1) * millimetres(header);
    origin[row] = scale * affine.m[row][3];
    for (int axis = 0; axis < 3; ++axis) steps[axis][row] = scale * affine.m[row][axis];
  }
  return placementOf(path, origin, steps);
}

void readSamples(const nifti_image& header, const std::string& path, SampleBuffer& to) {
  struct Close {
    void operator()(znzptr* file) const { znzclose(file); }
  };
  const int compressed = nifti_is_gzfile(header.iname);
  const std::unique_ptr<znzptr, Close> file(znzopen(header.iname, "rb", compressed));
  if (!file || znzseek(file.get(), header.iname_offset, SEEK_SET) < 0)
    throw Failure(path, text("cannot read the samples in %s", header.iname));
  const size_t got = znzread(to.data(), 1, to.bytes(), file.get());
  if (got != to.bytes())
    throw Failure(path, text("ends after %zu of %zu bytes of samples", got, to.bytes()));
  if (header.swapsize > 1 && header.byteorder != nifti_short_order())
    nifti_swap_Nbytes(to.bytes() / header.swapsize, header.swapsize, to.data());
}

}  // namespace

LoadedVolume readNifti(const VolumeRequest& request) {
  const std::string& path = request.path;
  const Header header = openHeader(path);
  if (!header->iname) throw Failure(path, "has no file with its samples");
  LoadedVolume volume;
  volume.placement = placementIn(*header, path);
  ItkHeader claimed;
  claimed.size = sizeOf(*header, path);
  claimed.frames = header->ndim > 3 ? header->nt : 1;
  claimed.type = sampleType(*header, path);
  SampleBuffer buffer = bufferFor(path, claimed, std::max<uint64_t>(fileSize(header->iname), 1));
  readSamples(*header, path, buffer);
  for (size_t axis = 0; axis < 3; ++axis)
    volume.size[axis] = static_cast<int32_t>(claimed.size[axis]);
  volume.frames = static_cast<int32_t>(claimed.frames);
  if (volume.frames > 1) volume.dimension = 4;
  volume.type = nameOf(claimed.type);
  // Slope 0 means that the samples are not scaled. A slope that is not finite is taken to mean the
  // same.
  const bool scaled = header->scl_slope != 0 && std::isfinite(header->scl_slope) &&
                      std::isfinite(header->scl_inter);
  volume.samples = scaled ? buffer.take(header->scl_slope, header->scl_inter) : buffer.take();
  if (const double shear = shearDegrees(volume.placement); shear > kNoticeableShear)
    volume.remarks.push_back(
        text("the axes are %.3g degrees from a right angle; the shear is kept", shear));
  takeFrame(volume, path, request.choices);
  return volume;
}

}  // namespace isostar::native
