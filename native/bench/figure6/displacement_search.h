#pragma once

#include <vector>

#include "bench/figure6/dual_surface.h"
#include "measure/triangle_tree.h"

namespace isostar::bench {

/// How far along its normal each vertex must go to lie on the source's surface, on whichever side
/// that is nearer; where the line misses the surface, to where it comes nearest. Without a surface,
/// nowhere.
[[nodiscard]] std::vector<double> displacements(const DualSurface&,
                                                const measure::TriangleTree& surface);

}  // namespace isostar::bench
