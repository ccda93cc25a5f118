#pragma once

#include <cstdint>
#include <optional>

#include "isostar/isostar.h"

namespace isostar::measure {

/// What a mesh is made of. Vertices without a triangle do not count, nor do triangles that name a
/// vertex twice.
struct Topology {
  uint64_t vertices = 0, edges = 0, triangles = 0;
  uint64_t components = 0;
  uint64_t boundaryEdges = 0;  // with one triangle
  uint64_t boundaryLoops = 0;
  uint64_t nonManifoldEdges = 0;  // with more than two triangles
  uint64_t misorientedEdges = 0;  // whose two triangles run along it the same way

  int64_t euler() const {
    return static_cast<int64_t>(vertices) - static_cast<int64_t>(edges) +
           static_cast<int64_t>(triangles);
  }

  /// Handles of all components together, each boundary closed by a disk; nothing where the mesh is
  /// no oriented manifold.
  std::optional<int64_t> genus() const;
};

Topology topologyOf(const Mesh&);

}  // namespace isostar::measure
