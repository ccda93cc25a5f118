#pragma once

#include "isostar/isostar.h"

namespace isostar::native {

/// A mesh in which vertices at equal positions are merged, without degenerate triangles and without
/// duplicates of the same orientation. It has no normals.
struct WeldedMesh {
  Mesh mesh;
  size_t degenerate = 0, doubled = 0;  // triangles left out
};

WeldedMesh weld(const Mesh&);

}  // namespace isostar::native
