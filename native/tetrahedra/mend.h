#pragma once

#include <string>

#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// Leaves out what an interpolating function cannot use (points of no tetrahedron, tetrahedra
/// without a volume, doubled ones), joins points of equal place and value, turns inverted
/// tetrahedra, and remarks how many of each there were. Afterwards every tetrahedron (a,b,c,d) has
/// (b-a) x (c-a) . (d-a) > 0. Fails with one line naming `path` where a point in use or its value
/// is not finite, or where no tetrahedron has a volume.
void mend(TetrahedralMesh&, const std::string& path);

}  // namespace isostar::native
