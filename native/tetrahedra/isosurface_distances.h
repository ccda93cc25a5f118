#pragma once

#include <vector>

#include "isostar/isostar.h"
#include "volume/sample_grid.h"

namespace isostar::native {

/// Replaces the samples (x fastest) of a field by signed distances to the isosurface, added to the
/// isovalue and clamped to a few steps. A piecewise linear field has a kink at each face, whereas
/// distances are linear where the isosurface is flat: marching cubes places its vertices closer to
/// the isosurface, and they take fewer bytes. Every sample stays on its side of the isovalue.
void replaceByDistances(const Mesh& isosurface, double isovalue, const SampleGrid&,
                        std::vector<float>& samples);

}  // namespace isostar::native
