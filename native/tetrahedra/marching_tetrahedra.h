#pragma once

#include "isostar/isostar.h"
#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// The isosurface of the piecewise linear function (§3): one or two triangles in each crossing
/// tetrahedron, one vertex on each crossing edge, counter-clockwise seen from the side of smaller
/// values, without normals. A value is positive if it is above the isovalue. The mesh must be
/// repaired.
Mesh isosurfaceOf(const TetrahedralMesh&, double isovalue);

}  // namespace isostar::native
