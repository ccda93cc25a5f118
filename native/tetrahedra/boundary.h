#pragma once

#include "isostar/isostar.h"
#include "tetrahedra/tetrahedral_mesh.h"
#include "tetrahedra/tetrahedron_tree.h"

namespace isostar::native {

/// Where the domain of a tetrahedral mesh ends: the faces behind which no tetrahedron lies.
struct Boundary {
  Mesh mesh;  // counter-clockwise seen from outside; vertices at equal places are one
  std::vector<uint32_t> tetrahedra;  // behind each triangle
  size_t hangingNodes =
      0;  // points on a face or edge of a tetrahedron that has them not as corners
};

/// Faces of a mended mesh that two tetrahedra share are inside; so are those of one that has others
/// before it, as where a coarse face meets finer ones (§4: such meshes do not conform), and where
/// points of unlike values lie at one place.
Boundary boundaryOf(const TetrahedralMesh&, const TetrahedronTree&);

}  // namespace isostar::native
