#pragma once

#include <array>
#include <cstdint>

#include "measure/vector3.h"

namespace isostar::native {

/// A grid of cubes along the world's axes: sample (i,j,k), x fastest, lies at `low + step ·
/// (i,j,k)`.
struct CubicGrid {
  measure::Vector3 low;
  double step = 1;
  std::array<int32_t, 3> size{};

  size_t count() const { return size_t(size[0]) * size_t(size[1]) * size_t(size[2]); }
  measure::Vector3 at(double i, double j, double k) const {
    return low + step * measure::Vector3{i, j, k};
  }
};

}  // namespace isostar::native
