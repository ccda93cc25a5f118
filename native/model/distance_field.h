#pragma once

#include <functional>
#include <vector>

#include "isostar/isostar.h"
#include "model/cubic_grid.h"

namespace isostar::native {

/// How many grid steps from the surface distances are told; farther samples are ± as much.
inline constexpr float kBand = 4;

/// A surface as the field whose isosurface 0 it is: distances in grid steps, positive where
/// insideVotes() says so. The mesh lies within the grid and has triangles. `progress` is called now
/// and then with 0 … 1, by any thread, one at a time.
std::vector<float> distanceField(const Mesh&, const CubicGrid&,
                                 const std::function<void(double)>& progress);

}  // namespace isostar::native
