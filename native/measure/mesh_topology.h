#pragma once

#include <cstdint>
#include <optional>

#include "isostar/isostar.h"

namespace isostar::measure {

/// Counts that describe a mesh's topology. Vertices without a triangle and triangles that use a
/// vertex twice are ignored.
struct Topology {
  uint64_t vertices = 0, edges = 0, triangles = 0;
  uint64_t components = 0;
  uint64_t boundaryEdges = 0;  // with one triangle
  uint64_t boundaryLoops = 0;
  uint64_t nonManifoldEdges = 0;  // with more than two triangles
  uint64_t misorientedEdges = 0;  // whose two triangles traverse them in the same direction

  int64_t euler() const {
    return static_cast<int64_t>(vertices) - static_cast<int64_t>(edges) +
           static_cast<int64_t>(triangles);
  }

  /// The handles of all components together, after closing each boundary loop by a disk. Nothing if
  /// the mesh is not an oriented manifold.
  std::optional<int64_t> genus() const;
};

Topology topologyOf(const Mesh&);

}  // namespace isostar::measure
