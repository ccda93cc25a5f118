// How far the surface told so far lies from the source's: what layers' heads state, and what holds the bound.
#pragma once

#include "crossings.h"
#include "field.h"
#include "scalars.h"

namespace isostar {

/// Distances in grid steps along the smallest spacing.
template <int D>
class SourceDistance {
 public:
  SourceDistance(const GridField<D>& field, const Header& header) : field_(field), header_(header) {}

  /// RMS distance of the surface that `cubes` makes of what is known, from a sample of its vertices. `active` as of
  /// activeBricks(signs); scalars may be empty.
  [[nodiscard]] double rms(const Signs<D>& signs, const Scalars<D>& scalars, const std::vector<uint8_t>& active) const;

  /// The bricks with an end of an edge on which a vertex of the finest surface is off by more than a bound, 1 marked, by
  /// place; empty if there is none. All scalars are known.
  [[nodiscard]] std::vector<uint8_t> beyond(double bound, const Signs<D>& signs, const Scalars<D>& scalars, const std::vector<uint8_t>& active) const;

 private:
  using Point = std::array<double, D>;

  [[nodiscard]] double crossing(const Coordinates<D>& even, const Coordinates<D>& odd) const;
  [[nodiscard]] Point normal(const Coordinates<D>& even, const Coordinates<D>& odd) const;
  [[nodiscard]] double nearest(const Point& sample, int32_t step) const;
  [[nodiscard]] double decoded(const ScalarWindow<D>& scalars, const EdgeEnds<D>& ends) const;

  const GridField<D>& field_;
  const Header& header_;
};

/// How many axis edges have ends of both signs: the vertices of marching cubes.
template <int D>
[[nodiscard]] uint64_t countCrossings(const Signs<D>& signs, const std::vector<uint8_t>& active);

/// The length of an edge along a set of axes, in grid steps along the smallest spacing. The fourth axis is time: a frame
/// counts as one step.
[[nodiscard]] double edgeLength(const Placement& placement, unsigned axes);

}  // namespace isostar
