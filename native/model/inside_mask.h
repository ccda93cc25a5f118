#pragma once

#include <vector>

#include "isostar/isostar.h"
#include "volume/sample_grid.h"

namespace isostar::native {

/// 1 for each sample inside the surface, else 0, by the parity of ray intersections and a majority
/// vote of the rays along the three axes. A ray with an odd number of intersections, which passed
/// through a hole, does not vote. A closed mesh has no such rays: triangles that share an edge
/// agree on which of them a ray intersects, regardless of rounding. The orientation of triangles
/// has no influence. The mesh must lie within the grid.
std::vector<uint8_t> insideMask(const Mesh&, const SampleGrid&);

}  // namespace isostar::native
