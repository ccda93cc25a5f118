#pragma once

#include <vector>

#include "bench/figure6/dual_surface.h"
#include "measure/triangle_tree.h"

namespace isostar::bench {

/// The displacement along its normal that moves each vertex to the source's surface, on the side
/// where that is nearer. If the line misses the surface, to the line's nearest point; without a
/// surface, 0.
[[nodiscard]] std::vector<double> displacements(const DualSurface&,
                                                const measure::TriangleTree& surface);

}  // namespace isostar::bench
