#pragma once

#include "isostar/isostar.h"
#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// The isosurface of the piecewise linear function (§3): a triangle or two in each crossing
/// tetrahedron, one vertex on each crossing edge, counter-clockwise seen from the side of smaller
/// values. Without normals. A value is positive where it is above the isovalue; the mesh is mended.
Mesh isosurfaceOf(const TetrahedralMesh&, double isovalue);

}  // namespace isostar::native
