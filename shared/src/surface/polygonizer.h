// From signs and scalars to triangles (§3, §5.3); independent of streams.
#pragma once

#include "isostar/isostar.h"
#include "surface/surface.h"

namespace isostar {

/// Makes the mesh, trimmed at the surface's domain if it has one. options.time and options.isovalue
/// are ignored. OverLimit, and an empty mesh, if it has more vertices than limits.vertices or
/// making it takes more bytes than limits.memory.
[[nodiscard]] Error polygonize(const Surface<3>&, const MeshOptions&, const Limits&,
                               const RunTasks&, Mesh& out);

}  // namespace isostar
