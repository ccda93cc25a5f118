#include "bench/figure6/displacement_search.h"

#include <algorithm>
#include <cmath>

#include "measure/in_parallel.h"

namespace isostar::bench {
namespace {

double displacement(const measure::TriangleTree& surface, const DualSurface::Point& from,
                    const DualSurface::Point& normal) {
  // Spheres of the free distance lead to the surface. Of two places as near to it the one nearer to
  // the vertex is taken.
  constexpr double kFarthest = 1.5, kThere = 1e-3, kTie = 1e-2;
  double best = 0, nearest = INFINITY;
  uint32_t near = 0;
  for (double side : {1.0, -1.0}) {
    for (double t = 0; t < kFarthest;) {
      const double free =
          surface.distance({from[0] + side * t * normal[0], from[1] + side * t * normal[1],
                            from[2] + side * t * normal[2]},
                           near);
      if (free + kTie * t < nearest) {
        nearest = free + kTie * t;
        best = side * t;
      }
      if (free < kThere) break;
      t += std::max(free, kThere);
    }
  }
  return best;
}

}  // namespace

std::vector<double> displacements(const DualSurface& dual, const measure::TriangleTree& surface) {
  constexpr size_t kAtOnce = 1024;
  std::vector<double> all(dual.vertices());
  if (surface.size() == 0) return all;
  measure::inParallel((all.size() + kAtOnce - 1) / kAtOnce, [&](size_t task) {
    for (size_t v = task * kAtOnce; v < std::min(all.size(), (task + 1) * kAtOnce); ++v)
      all[v] = displacement(surface, dual.position(v), dual.normal(v));
  });
  return all;
}

}  // namespace isostar::bench
