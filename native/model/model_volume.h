#pragma once

#include <functional>
#include <string>

#include "volume/loaded_volume.h"

namespace isostar::native {

/// Samples along the longest axis where the user names no number, and the fewest and most that make
/// sense.
inline constexpr int kModelGrid = 257, kSmallestModelGrid = 16, kLargestModelGrid = 2048;

/// A closed triangle mesh as its distance field, whose isosurface 0 it is (so the paper's horse
/// came to its 257³ samples, figure 1): a grid of cubes, `grid` samples along the longest side, in
/// the model's own coordinates. What is wrong with a mesh that is open, has doubled triangles or
/// edges of many becomes a remark; one without any area, or larger than the codec's grids, fails
/// with one line.
LoadedVolume modelVolume(const Mesh&, const std::string& path, int grid,
                         const std::function<void(double)>& progress);

}  // namespace isostar::native
