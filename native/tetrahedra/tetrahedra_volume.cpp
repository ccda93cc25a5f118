#include "tetrahedra/tetrahedra_volume.h"

#include "files/text.h"
#include "tetrahedra/isosurface_distances.h"
#include "tetrahedra/resampled_field.h"

namespace isostar::native {
namespace {

/// The sampling error is reported because the encoder's bound is relative to the samples.
void remarkOnSampling(TetrahedraVolume& result, double step) {
  if (!result.distance) return;
  const auto& size = result.volume.size;
  const measure::Distance distance = result.distance->symmetric();
  result.volume.remarks.push_back(
      text("sampled at %d x %d x %d points, up to %.2g grid steps from the isosurface of the "
           "tetrahedra (RMS %.2g)",
           size[0], size[1], size[2], distance.max / step, distance.rms / step));
}

}  // namespace

TetrahedraVolume volumeOf(const TetrahedralField& field, const Mesh& isosurface, double isovalue,
                          Scalars scalars, const SampleGrid& grid,
                          const std::function<void(double)>& progress) {
  TetrahedraVolume result;
  ResampledField sampled = resample(field, grid, progress);
  LoadedVolume& volume = result.volume;
  volume.samples = std::move(sampled.samples);
  if (scalars == Scalars::Distances) replaceByDistances(isosurface, isovalue, grid, volume.samples);
  volume.domain = std::move(sampled.domain);
  volume.size = grid.size;
  volume.placement.origin = {grid.low.x, grid.low.y, grid.low.z};
  volume.placement.spacing = {grid.steps.x, grid.steps.y, grid.steps.z};
  volume.remarks = field.mesh().remarks;
  Mesh surface;
  if (polygonize(volume.view(), isovalue, {.normals = false}, surface) == Error::None)
    result.distance = measure::surfaceDistance(surface, isosurface);
  remarkOnSampling(result, grid.smallestStep());
  return result;
}

}  // namespace isostar::native
