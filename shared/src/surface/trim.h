// The end of a surface inside the box: triangles are cut where a function, linear on each of them,
// is 0 (§2).
#pragma once

#include "isostar/isostar.h"

namespace isostar {

/// Keeps the part of a mesh where a value given for each of its vertices is at least 0. A new
/// vertex lies on each edge whose ends are kept and not, shared by the triangles beside it, so that
/// a manifold stays one and ends in clean curves. OverLimit where that has more vertices than
/// allowed or takes more memory; the mesh itself counts, too.
[[nodiscard]] Error trim(const std::vector<float>& values, const Limits& limits, Mesh& mesh);

}  // namespace isostar
