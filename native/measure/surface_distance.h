#pragma once

#include <optional>

#include "isostar/isostar.h"

namespace isostar::measure {

struct Distance {
  double mean = 0, rms = 0, max = 0;
};

/// How far two surfaces are apart, in the unit of their coordinates.
struct SurfaceDistance {
  Distance aToB, bToA;
  Distance symmetric() const;  // the larger of the two directions, each for itself
};

/// Distances are exact, from points to the other mesh's triangles; the points are the vertices (for the maximum) and
/// about as many points spread evenly over the area (for all three). The same meshes give the same numbers.
/// Nothing where either mesh has no triangle.
std::optional<SurfaceDistance> surfaceDistance(const Mesh& a, const Mesh& b);

}  // namespace isostar::measure
