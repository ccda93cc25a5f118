#include "volume/placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

double determinant(const std::array<double, 9>& m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

bool allFinite(const auto& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

Placement placementOf(const std::string& file, const std::array<double, 3>& origin,
                      const AxisSteps& steps) {
  Placement placement{origin, {}, {}};
  if (!allFinite(origin)) throw Failure(file, "the origin is not finite");
  for (int axis = 0; axis < 3; ++axis) {
    const auto& step = steps[axis];
    const double length = std::hypot(step[0], step[1], step[2]);
    if (!allFinite(step) || !(length > 0))
      throw Failure(file, text("the spacing along axis %d is %g; it must be positive and finite",
                               axis, length));
    placement.spacing[axis] = length;
    for (int row = 0; row < 3; ++row) placement.direction[3 * row + axis] = step[row] / length;
  }
  // With unit columns the determinant is the volume of a cell. No real scan is this flat.
  if (const double volume = determinant(placement.direction); std::abs(volume) < 1e-6)
    throw Failure(
        file,
        text("the directions of the axes cannot be inverted, their determinant is %g", volume));
  return placement;
}

double shearDegrees(const Placement& placement) {
  double worst = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a + 1; b < 3; ++b) {
      double cosine = 0;
      for (int row = 0; row < 3; ++row)
        cosine += placement.direction[3 * row + a] * placement.direction[3 * row + b];
      worst = std::max(worst, std::asin(std::min(1.0, std::abs(cosine))));
    }
  }
  return worst * 180 / std::numbers::pi;
}

double smallestSpacing(const Placement& placement) {
  return *std::min_element(placement.spacing.begin(), placement.spacing.end());
}

}  // namespace isostar::native
