// From known signs and scalars to triangles (§3, §5.3). It has no idea that a stream exists.
#pragma once

#include "isostar/isostar.h"
#include "surface/surface.h"

namespace isostar {

/// OverLimit, and no mesh, where it would have more vertices than allowed, or where it takes more
/// memory to make it.
[[nodiscard]] Error polygonize(const Surface<3>&, const MeshOptions&, const Limits&, Mesh& out);

}  // namespace isostar
