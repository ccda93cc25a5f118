#include "tetrahedra/as_distances.h"

#include <algorithm>
#include <cmath>

#include "measure/in_parallel.h"
#include "tetrahedra/rimmed_surface.h"

namespace isostar::native {
namespace {

constexpr double kBand =
    8;  // smallest steps: more than a cell's diagonal on any grid of gridOver()
constexpr double kLeast = 1e-4;  // smallest steps: a positive sample stays positive

/// What a step counts, so that single-precision numbers beside the isovalue tell small parts of
/// one, and none is too large or too small for them.
double unitBeside(double isovalue) {
  return isovalue == 0
             ? 1
             : std::exp2(std::clamp(std::ceil(std::log2(std::abs(isovalue))), -100.0, 120.0));
}

}  // namespace

void becomeDistances(const Mesh& isosurface, double isovalue, const SampleGrid& grid,
                     std::vector<float>& samples) {
  if (isosurface.indices.empty()) return;
  const RimmedSurface surface(isosurface);
  const double step = grid.smallestStep(), unit = unitBeside(isovalue);
  const auto layer = size_t(grid.size[0]) * size_t(grid.size[1]);
  measure::inParallel(static_cast<size_t>(grid.size[2]), [&](size_t k) {
    uint32_t near = 0;
    size_t sample = k * layer;
    for (int j = 0; j < grid.size[1]; ++j) {
      double known = 0;  // no less than this far away, in steps; it shrinks from sample to sample
      for (int i = 0; i < grid.size[0]; ++i, ++sample, known -= grid.steps.x / step) {
        double magnitude = kBand;
        if (known < kBand) {
          const auto [toItself, continued] =
              surface.distance(grid.at(i, j, static_cast<double>(k)), near);
          known = toItself / step;
          magnitude = std::clamp(continued / step, kLeast, kBand);
        }
        const bool positive = samples[sample] > isovalue;
        samples[sample] = static_cast<float>(isovalue + (positive ? unit : -unit) * magnitude);
      }
    }
  });
}

}  // namespace isostar::native
