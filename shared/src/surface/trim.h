// Trims a mesh where a function that is linear on each triangle is 0: the end of a surface inside
// the box (§2).
#pragma once

#include "isostar/isostar.h"

namespace isostar {

/// Keeps the part of a mesh where `values`, one per vertex, are at least 0. Each edge with one end
/// kept gets a new vertex, which the triangles beside it share, so that a manifold remains one and
/// ends in clean curves. OverLimit if the result has more vertices than limits.vertices or takes
/// more bytes than limits.memory, the mesh itself included; the mesh is then unspecified.
[[nodiscard]] Error trim(const std::vector<float>& values, const Limits& limits, Mesh& mesh);

}  // namespace isostar
