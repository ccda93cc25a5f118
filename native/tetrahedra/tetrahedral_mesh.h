#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "measure/vector3.h"

namespace isostar::native {

/// A tetrahedron by its points.
using Corners4 = std::array<uint32_t, 4>;

/// Irregular data (§1): a scalar at each point of a tetrahedral mesh, linear within each
/// tetrahedron.
struct TetrahedralMesh {
  std::vector<measure::Vector3> points;
  std::vector<float> values;  // one a point
  std::vector<Corners4> tetrahedra;
  std::vector<std::string> remarks;  // what its reader found worth saying
};

}  // namespace isostar::native
