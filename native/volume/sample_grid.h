#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "measure/vector3.h"

namespace isostar::native {

/// A grid along the world's axes with its own spacing on each: sample (i,j,k), x fastest, is at
/// `low + steps ∘ (i,j,k)`.
struct SampleGrid {
  measure::Vector3 low, steps;
  std::array<int32_t, 3> size{};

  size_t count() const { return size_t(size[0]) * size_t(size[1]) * size_t(size[2]); }
  size_t index(int32_t i, int32_t j, int32_t k) const {
    return (size_t(k) * size_t(size[1]) + size_t(j)) * size_t(size[0]) + size_t(i);
  }
  double smallestStep() const { return std::min({steps.x, steps.y, steps.z}); }
  /// A point of the world as fractional i, j, k.
  measure::Vector3 inSteps(const measure::Vector3& position) const {
    const measure::Vector3 offset = position - low;
    return {offset.x / steps.x, offset.y / steps.y, offset.z / steps.z};
  }
  measure::Vector3 at(double i, double j, double k) const {
    return low + measure::Vector3{i * steps.x, j * steps.y, k * steps.z};
  }
};

}  // namespace isostar::native
