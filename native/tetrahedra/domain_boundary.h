#pragma once

#include "isostar/isostar.h"
#include "tetrahedra/tetrahedral_mesh.h"
#include "tetrahedra/tetrahedron_tree.h"

namespace isostar::native {

/// The boundary of the domain of a tetrahedral mesh: the faces with no tetrahedron on their other
/// side.
struct Boundary {
  Mesh mesh;  // counter-clockwise seen from outside; vertices at equal positions are merged
  std::vector<uint32_t> tetrahedra;  // the tetrahedron of each triangle
  size_t hangingNodes = 0;  // points on a face or edge of a tetrahedron, but not its corners
};

/// The mesh must be repaired. Faces shared by two tetrahedra are interior. So are faces with
/// another tetrahedron in front of them, as where a coarse face meets finer ones (§4: such meshes
/// do not conform), or where points at one position have different values.
Boundary boundaryOf(const TetrahedralMesh&, const TetrahedronTree&);

}  // namespace isostar::native
