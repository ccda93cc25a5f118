#pragma once

#include <string>

#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// Removes what interpolation cannot use (points of no tetrahedron, tetrahedra without a volume,
/// doubled ones), merges points of equal position and value, reorients inverted tetrahedra, and
/// adds a remark with the count of each. Afterwards every tetrahedron (a,b,c,d) has (b-a) x (c-a) .
/// (d-a) > 0. Throws a Failure naming `path` if a point in use or its value is not finite, or if no
/// tetrahedron has a volume.
void repair(TetrahedralMesh&, const std::string& path);

}  // namespace isostar::native
