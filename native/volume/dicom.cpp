// DICOM, read by ITK's GDCM. Slices are placed by their positions, not by the spacing tags, which
// are often wrong.
#include <itkGDCMImageIO.h>
#include <itkMetaDataObject.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "files/failure.h"
#include "files/text.h"
#include "volume/captured_errors.h"
#include "volume/itk_image.h"
#include "volume/named_files.h"
#include "volume/placement.h"
#include "volume/volume_formats.h"

namespace isostar::native {
namespace {

/// As a fraction of the slice distance: positions are rounded to a few decimals.
constexpr double kGapTolerance = 0.02;

using Point = std::array<double, 3>;

struct Slice {
  std::string path;
  ItkHeader header;
  double height = 0;  // along the normal of the slices
};
using Series = std::vector<Slice>;

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point column(const Placement& placement, int axis) {
  return {placement.direction[axis], placement.direction[3 + axis], placement.direction[6 + axis]};
}

Point normalOf(const Placement& placement) {
  const Point a = column(placement, 0), b = column(placement, 1);
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::string tag(const itk::ImageIOBase& io, const char* name) {
  std::string value;
  itk::ExposeMetaData<std::string>(io.GetMetaDataDictionary(), name, value);
  return oneLine(value);
}

/// What all slices of one volume have in common: series, size and orientation.
std::string seriesKey(const itk::ImageIOBase& io, const ItkHeader& header) {
  std::string key =
      text("%s %lldx%lld", tag(io, "0020|000e").c_str(), static_cast<long long>(header.size[0]),
           static_cast<long long>(header.size[1]));
  for (double cosine : normalOf(header.placement)) key += text(" %.3f", cosine + 0.0);
  return key;
}

/// Every series in the folder. Files that are not DICOM images (DICOMDIR, notes) are skipped.
std::map<std::string, Series> findSeries(const std::vector<std::string>& paths) {
  std::map<std::string, Series> series;
  for (const std::string& path : paths) {
    const auto io = itk::GDCMImageIO::New();
    if (!io->CanReadFile(path.c_str())) continue;
    const ItkHeader header = readHeader(*io, path);
    if (header.size[2] == 1) series[seriesKey(*io, header)].push_back({path, header});
  }
  return series;
}

void sortByHeight(Series& slices) {
  const Point normal = normalOf(slices.front().header.placement);
  for (Slice& slice : slices) slice.height = dot(slice.header.placement.origin, normal);
  std::sort(slices.begin(), slices.end(),
            [](const Slice& a, const Slice& b) { return a.height < b.height; });
}

/// Unevenly spaced slices do not form a grid: one is missing, or two overlap.
void requireEvenGaps(const std::string& folder, const Series& slices) {
  const size_t last = slices.size() - 1;
  std::vector<double> gaps;
  for (size_t k = 0; k < last; ++k) gaps.push_back(slices[k + 1].height - slices[k].height);
  std::vector<double> sorted = gaps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<ptrdiff_t>(last / 2), sorted.end());
  const double usual = sorted[last / 2];
  for (size_t k = 0; k < last; ++k) {
    if (gaps[k] <= 0 || std::abs(gaps[k] - usual) > kGapTolerance * usual)
      throw Failure(
          folder,
          text("slices %zu and %zu are %.4g mm apart, the others %.4g: one is missing or doubled",
               k + 1, k + 2, gaps[k], usual));
  }
}

/// The step from slice to slice may be oblique (a tilted gantry). It is kept unchanged.
Placement placementOfSeries(const std::string& folder, const Series& slices) {
  const Placement& first = slices.front().header.placement;
  if (slices.size() == 1) return first;
  const Point& end = slices.back().header.placement.origin;
  const double steps = static_cast<double>(slices.size() - 1);
  AxisSteps axes{};
  for (int row = 0; row < 3; ++row) {
    for (int axis = 0; axis < 2; ++axis)
      axes[axis][row] = first.spacing[axis] * first.direction[3 * row + axis];
    axes[2][row] = (end[row] - first.origin[row]) / steps;
  }
  return placementOf(folder, first.origin, axes);
}

/// GDCM pads missing samples of a truncated file, and only prints a warning.
LoadedVolume readWholeFile(const std::string& path) {
  const CapturedErrors errors;
  LoadedVolume volume = readWholeImage(*itk::GDCMImageIO::New(), path, false);
  if (errors.line().find("Incomplete Pixel Data") != std::string::npos)
    throw Failure(path, "ends within its samples");
  return volume;
}

LoadedVolume readSlices(const std::string& folder, const Series& slices) {
  const ItkHeader& first = slices.front().header;
  const size_t count = slices.size();
  const size_t area = static_cast<size_t>(first.size[0]) * static_cast<size_t>(first.size[1]);
  // Slices may differ in type and slope: each is converted to float separately.
  SampleBuffer whole(folder, {first.size[0], first.size[1], static_cast<int64_t>(count)},
                     SampleType::F32, 0);
  auto* const to = reinterpret_cast<float*>(whole.data());
  for (size_t k = 0; k < count; ++k) {
    const std::vector<float> samples = readWholeFile(slices[k].path).samples;
    std::copy(samples.begin(), samples.end(), to + k * area);
  }
  LoadedVolume volume;
  volume.size = whole.size();
  volume.placement = placementOfSeries(folder, slices);
  volume.samples = whole.take();
  return volume;
}

}  // namespace

LoadedVolume readDicomFile(const VolumeRequest& request) {
  return readWholeFile(request.path);
}

LoadedVolume readDicomSeries(const VolumeRequest& request) {
  const std::string& folder = request.path;
  quietItk();
  std::map<std::string, Series> all = findSeries(filesIn(folder));
  if (all.empty()) throw Failure(folder, "holds neither DICOM nor TIFF slices");
  Series& slices = std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
                     return a.second.size() < b.second.size();
                   })->second;
  sortByHeight(slices);
  requireEvenGaps(folder, slices);
  LoadedVolume volume = readSlices(folder, slices);
  if (all.size() > 1)
    volume.remarks.push_back(
        text("the folder holds %zu series; the largest, of %zu slices, is read", all.size(),
             slices.size()));
  return volume;
}

}  // namespace isostar::native
