// How far the surface told so far lies from the source's: what layers' heads state, and what holds the bound.
#pragma once

#include "field.h"
#include "scalars.h"

namespace isostar {

/// Distances in grid steps along the smallest spacing.
class SourceDistance {
 public:
  SourceDistance(const VolumeField& field, const Header& header) : field_(field), header_(header) {}

  /// RMS distance of the surface that `cubes` makes, from a sample of its vertices.
  [[nodiscard]] double rms(const Signs<3>& signs, const Scalars<3>& scalars, const std::vector<uint8_t>& active) const;

  /// The largest distance by which a vertex of the finest surface is off its place on its edge.
  [[nodiscard]] double largest(const Signs<3>& signs, const Scalars<3>& scalars, Polygonizer polygonizer) const;

 private:
  const VolumeField& field_;
  const Header& header_;
};

/// How many axis edges have ends of both signs: the vertices of marching cubes.
[[nodiscard]] uint64_t countCrossings(const Signs<3>& signs);

}  // namespace isostar
