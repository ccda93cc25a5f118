#include "bench/figure6/displacement_search.h"

#include <algorithm>
#include <cmath>

#include "threads/parallel_tasks.h"

namespace isostar::bench {
namespace {

double displacement(const measure::TriangleTree& surface, const DualSurface::Point& from,
                    const DualSurface::Point& normal) {
  // Sphere tracing. Of two points at about the same distance from the surface, the one nearer to
  // the vertex is taken.
  constexpr double kFarthest = 1.5, kReached = 1e-3, kTie = 1e-2;
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
      if (free < kReached) break;
      t += std::max(free, kReached);
    }
  }
  return best;
}

}  // namespace

std::vector<double> displacements(const DualSurface& dual, const measure::TriangleTree& surface) {
  constexpr size_t kVerticesPerTask = 1024;
  std::vector<double> all(dual.vertices());
  if (surface.size() == 0) return all;
  runInParallel((all.size() + kVerticesPerTask - 1) / kVerticesPerTask, [&](size_t task) {
    for (size_t v = task * kVerticesPerTask;
         v < std::min(all.size(), (task + 1) * kVerticesPerTask); ++v)
      all[v] = displacement(surface, dual.position(v), dual.normal(v));
  });
  return all;
}

}  // namespace isostar::bench
