#pragma once

#include "isostar/isostar.h"

namespace isostar::native {

/// A mesh whose vertices at equal places are one, without triangles that then name a vertex twice,
/// and with one of those that are the same, orientation included. Without normals.
struct WeldedMesh {
  Mesh mesh;
  size_t degenerate = 0, doubled = 0;  // triangles left out
};

WeldedMesh weld(const Mesh&);

}  // namespace isostar::native
