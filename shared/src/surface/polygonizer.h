// From signs and scalars to triangles (§3, §5.3); independent of streams.
#pragma once

#include "isostar/isostar.h"
#include "surface/surface.h"

namespace isostar {

/// A part of a mesh: some bricks' cells, and the vertices on the edges that begin in them.
struct MeshPart {
  std::vector<uint8_t> bricks;  // by brick index: 1 for those of the part, else 0
  std::vector<MeshRun> runs;    // receives where vertices and triangles belong
};

/// Makes the mesh, trimmed at the surface's domain if it has one. options.time and options.isovalue
/// are ignored. OverLimit, and an empty mesh, if it has more vertices than limits.vertices or
/// making it takes more bytes than limits.memory. `part`: makes that part only; not for a surface
/// with a domain.
[[nodiscard]] Error polygonize(const Surface<3>&, const MeshOptions&, const Limits&,
                               const RunTasks&, Mesh& out, MeshPart* part = nullptr);

}  // namespace isostar
