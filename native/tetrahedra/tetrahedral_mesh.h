#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "measure/vector3.h"

namespace isostar::native {

/// A tetrahedron as the indices of its points.
using Corners4 = std::array<uint32_t, 4>;

/// Irregular data (§1): a value at each point of a tetrahedral mesh, interpolated linearly within
/// each tetrahedron.
struct TetrahedralMesh {
  std::vector<measure::Vector3> points;
  std::vector<float> values;  // one per point
  std::vector<Corners4> tetrahedra;
  std::vector<std::string> remarks;  // warnings for the user
};

}  // namespace isostar::native
