#pragma once

#include <vector>

#include "isostar/isostar.h"
#include "volume/sample_grid.h"

namespace isostar::native {

/// The fraction of the surface's area, 0 … 1, around which all samples have one sign: parts too
/// thin for the grid. Each triangle is tested at its centroid.
double lostAreaFraction(const Mesh&, const SampleGrid&, const std::vector<float>& samples);

}  // namespace isostar::native
