#pragma once

#include <functional>
#include <string>

#include "volume/loaded_volume.h"

namespace isostar::native {

/// Samples along the longest axis: the default, the minimum and the maximum.
inline constexpr int kModelGrid = 257, kSmallestModelGrid = 16, kLargestModelGrid = 2048;

/// The distance field of a closed triangle mesh, whose isosurface 0 is the mesh (as the paper's
/// horse has 257³ samples, figure 1): a grid of cubes with `grid` samples along the longest side,
/// in the model's coordinates. Boundary edges, doubled triangles and edges of more than two
/// triangles become remarks. Throws a Failure if the mesh has no area or the grid is too large for
/// the codec.
LoadedVolume modelVolume(const Mesh&, const std::string& path, int grid,
                         const std::function<void(double)>& progress);

}  // namespace isostar::native
