// From known signs and scalars to triangles (§3, §5.3). It has no idea that a stream exists.
#pragma once

#include "isostar/isostar.h"
#include "surface.h"

namespace isostar {

/// OverLimit where the mesh would have more vertices than allowed.
[[nodiscard]] Error polygonize(const Surface<3>&, const MeshOptions&, uint64_t mostVertices, Mesh& out);

}  // namespace isostar
