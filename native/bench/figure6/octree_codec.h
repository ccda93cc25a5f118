#pragma once

#include <span>
#include <vector>

#include "isostar/isostar.h"
#include "measure/triangle_tree.h"

namespace isostar::bench {

/// Encodes the signs of an octree and then the displacements of a dual surface's vertices, after
/// Lee, Desbrun and Schröder; for comparison only. `surface` is the source's, in grid steps.
[[nodiscard]] std::vector<std::byte> encodeOctree(const Volume& volume, double isovalue,
                                                  const measure::TriangleTree& surface);

/// A layer of a stream: the signs of a level, which are useless if the layer is torn, or a bit
/// plane of displacements.
struct OctreeLayer {
  size_t end;  // bytes of the stream up to the layer's end
  bool signs;
};
[[nodiscard]] std::vector<OctreeLayer> octreeLayers(std::span<const std::byte>);

/// The surface of a prefix, in grid steps times `unit`. A volume of one sample along an axis has
/// none.
[[nodiscard]] Mesh decodeOctree(std::span<const std::byte> prefix,
                                const std::array<double, 3>& unit);

}  // namespace isostar::bench
