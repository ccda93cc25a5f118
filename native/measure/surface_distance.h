#pragma once

#include <optional>

#include "isostar/isostar.h"
#include "measure/triangle_tree.h"

namespace isostar::measure {

struct Distance {
  double mean = 0, rms = 0, max = 0;
};

/// The distance between two surfaces, in the unit of their coordinates.
struct SurfaceDistance {
  Distance aToB, bToA;
  Distance symmetric() const;  // the larger value of the two directions for each measure
};

/// A mesh with its search tree, for repeated measurements. The mesh must outlive it and have
/// triangles.
struct Measurable {
  explicit Measurable(const Mesh&);

  const Mesh& mesh;
  TriangleTree tree;
};

/// Exact distances from points of one mesh to the triangles of the other. The points are the
/// vertices (for the maximum) and about as many points distributed evenly over the area (for all
/// three measures). Results are reproducible. Nothing if either mesh has no triangle.
std::optional<SurfaceDistance> surfaceDistance(const Mesh& a, const Mesh& b);

/// The same from at most `points` points and `points` vertices of each mesh: faster, and the
/// maximum may be too small.
SurfaceDistance surfaceDistance(const Measurable& a, const Measurable& b, size_t points);

}  // namespace isostar::measure
