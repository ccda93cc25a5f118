#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "measure/vector3.h"

namespace isostar::native {

/// A grid along the world's axes, evenly spaced on each: sample (i,j,k), x fastest, lies at `low +
/// steps ∘ (i,j,k)`.
struct SampleGrid {
  measure::Vector3 low, steps;
  std::array<int32_t, 3> size{};

  size_t count() const { return size_t(size[0]) * size_t(size[1]) * size_t(size[2]); }
  double smallestStep() const { return std::min({steps.x, steps.y, steps.z}); }
  /// A place as i, j, k, fractions included.
  measure::Vector3 inSteps(const measure::Vector3& place) const {
    const measure::Vector3 offset = place - low;
    return {offset.x / steps.x, offset.y / steps.y, offset.z / steps.z};
  }
  measure::Vector3 at(double i, double j, double k) const {
    return low + measure::Vector3{i * steps.x, j * steps.y, k * steps.z};
  }
};

}  // namespace isostar::native
