#pragma once

#include <optional>

#include "isostar/isostar.h"
#include "measure/triangle_tree.h"

namespace isostar::measure {

struct Distance {
  double mean = 0, rms = 0, max = 0;
};

/// How far two surfaces are apart, in the unit of their coordinates.
struct SurfaceDistance {
  Distance aToB, bToA;
  Distance symmetric() const;  // the larger of the two directions, each for itself
};

/// A mesh made ready for measuring, for who measures it more than once. The mesh must outlive it
/// and have triangles.
struct Measurable {
  explicit Measurable(const Mesh&);

  const Mesh& mesh;
  TriangleTree tree;
};

/// Distances are exact, from points to the other mesh's triangles; the points are the vertices (for
/// the maximum) and about as many points spread evenly over the area (for all three). The same
/// meshes give the same numbers. Nothing where either mesh has no triangle.
std::optional<SurfaceDistance> surfaceDistance(const Mesh& a, const Mesh& b);

/// The same from at most `points` points and `points` vertices of each mesh: quicker, and the
/// maximum may miss some.
SurfaceDistance surfaceDistance(const Measurable& a, const Measurable& b, size_t points);

}  // namespace isostar::measure
