#pragma once

#include <functional>
#include <vector>

#include "isostar/isostar.h"
#include "volume/sample_grid.h"

namespace isostar::native {

/// Distances are exact up to this many grid steps from the surface; samples farther away are
/// ±kBand.
inline constexpr float kBand = 4;

/// The field whose isosurface 0 is the surface: distances in grid steps, positive where
/// insideMask() is 1. The mesh must lie within the grid, which has equal steps, and have triangles.
/// `progress` is called with 0 … 1 by any thread, one at a time.
std::vector<float> distanceField(const Mesh&, const SampleGrid&,
                                 const std::function<void(double)>& progress);

}  // namespace isostar::native
