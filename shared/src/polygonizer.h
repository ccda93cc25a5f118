// From known signs and scalars to triangles (§3, §5.3). It has no idea that a stream exists.
#pragma once

#include "isostar/isostar.h"
#include "scalars.h"

namespace isostar {

/// What a surface is made of.
struct Surface {
  const Signs<3>& signs;
  const Scalars<3>& scalars;  // of all ends of edges that the polygonizer crosses
  /// What to add to half quanta at positive and negative vertices to be exact.
  double positiveOffset = 0, negativeOffset = 0;
  const Placement& placement;
};

/// OverLimit where the mesh would have more vertices than allowed.
[[nodiscard]] Error polygonize(const Surface&, const MeshOptions&, uint64_t mostVertices, Mesh& out);

}  // namespace isostar
