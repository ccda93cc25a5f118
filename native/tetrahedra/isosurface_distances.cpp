#include "tetrahedra/isosurface_distances.h"

#include <algorithm>
#include <cmath>

#include "tetrahedra/extended_surface.h"
#include "threads/parallel_tasks.h"

namespace isostar::native {
namespace {

/// In smallest steps: more than a cell's diagonal on any grid of chooseGrid().
constexpr double kBand = 8;
constexpr double kLeast = 1e-4;  // in smallest steps: a positive sample stays positive

/// The scale of distances: added to the isovalue in single precision, they must resolve small
/// fractions of a step and must not overflow or underflow.
double unitBeside(double isovalue) {
  return isovalue == 0
             ? 1
             : std::exp2(std::clamp(std::ceil(std::log2(std::abs(isovalue))), -100.0, 120.0));
}

}  // namespace

void replaceByDistances(const Mesh& isosurface, double isovalue, const SampleGrid& grid,
                        std::vector<float>& samples) {
  if (isosurface.indices.empty()) return;
  const ExtendedSurface surface(isosurface);
  const double step = grid.smallestStep(), unit = unitBeside(isovalue);
  const auto layer = size_t(grid.size[0]) * size_t(grid.size[1]);
  runInParallel(static_cast<size_t>(grid.size[2]), [&](size_t k) {
    uint32_t near = 0;
    size_t sample = k * layer;
    for (int j = 0; j < grid.size[1]; ++j) {
      double known = 0;  // a lower bound of the distance, in smallest steps
      for (int i = 0; i < grid.size[0]; ++i, ++sample, known -= grid.steps.x / step) {
        double magnitude = kBand;
        if (known < kBand) {
          const auto [toSurface, toExtension] =
              surface.distance(grid.at(i, j, static_cast<double>(k)), near);
          known = toSurface / step;
          magnitude = std::clamp(toExtension / step, kLeast, kBand);
        }
        const bool positive = samples[sample] > isovalue;
        samples[sample] = static_cast<float>(isovalue + (positive ? unit : -unit) * magnitude);
      }
    }
  });
}

}  // namespace isostar::native
