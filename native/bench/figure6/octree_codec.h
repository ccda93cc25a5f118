#pragma once

#include <span>
#include <vector>

#include "isostar/isostar.h"
#include "measure/triangle_tree.h"

namespace isostar::bench {

/// The signs of an octree, then displacements of a dual surface's vertices, in the manner of Lee,
/// Desbrun and Schröder; for comparison only. `surface` is the source's, in grid steps.
[[nodiscard]] std::vector<std::byte> encodeOctree(const Volume& volume, double isovalue,
                                                  const measure::TriangleTree& surface);

/// A layer of a stream: the signs of a level, of which a torn one shows nothing, or a plane of
/// displacements.
struct OctreeLayer {
  size_t end;  // in the stream
  bool signs;
};
[[nodiscard]] std::vector<OctreeLayer> octreeLayers(std::span<const std::byte>);

/// The surface that a prefix tells, in samples times `unit`. A volume without extent on some axis
/// has none.
[[nodiscard]] Mesh decodeOctree(std::span<const std::byte> prefix,
                                const std::array<double, 3>& unit);

}  // namespace isostar::bench
