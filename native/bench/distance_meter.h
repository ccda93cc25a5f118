#pragma once

#include <optional>

#include "measure/surface_distance.h"

namespace isostar::bench {

/// Measures the distance of surfaces from the source's, in grid steps. The source must outlive it
/// and have triangles.
class DistanceMeter {
 public:
  DistanceMeter(const Mesh& source, size_t points) : source_(source), points_(points) {}

  /// The larger of both directions; nothing if the mesh has no triangle.
  std::optional<measure::Distance> distance(const Mesh&) const;

  /// The same from every vertex, which makes the maximum reliable.
  std::optional<measure::Distance> thoroughDistance(const Mesh&) const;

 private:
  measure::Measurable source_;
  size_t points_;
};

}  // namespace isostar::bench
