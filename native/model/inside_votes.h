#pragma once

#include <vector>

#include "isostar/isostar.h"
#include "model/cubic_grid.h"

namespace isostar::native {

/// Which samples a surface has inside, as 1 and 0: each sheet that a ray meets leads from outside
/// to inside or back, and the rays along the three axes vote. A ray that a hole lets out (an odd
/// number of sheets) has no vote. Triangles that share an edge agree on which of them a ray meets,
/// whatever rounding does, so that a closed mesh has no such rays; orientation does not matter. The
/// mesh lies within the grid.
std::vector<uint8_t> insideVotes(const Mesh&, const CubicGrid&);

}  // namespace isostar::native
