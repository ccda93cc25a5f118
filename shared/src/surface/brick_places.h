// Where the vertices of a brick, and the first ones of the next bricks, lie in a mesh's frame.
#pragma once

#include <array>

#include "grid/brick_table.h"
#include "surface/frames.h"

namespace isostar {

/// A position is the sum of three parts, one for each axis and plane.
class BrickPlaces {
 public:
  using Pair [[gnu::vector_size(16)]] = double;
  struct Place {
    Pair xy, z;  // z: the second number is 0
  };

  /// `brick`: its brick coordinates.
  void enter(const Frames& frames, const Coordinates<3>& brick) {
    for (int a = 0; a < 3; ++a) {
      for (int i = 0; i <= kBrickSide; ++i) {
        const glm::dvec3 part = frames.part(a, brick[a] * kBrickSide + i);
        parts_[static_cast<std::size_t>(a)][static_cast<std::size_t>(i)] = {Pair{part.x, part.y},
                                                                            Pair{part.z, 0}};
      }
    }
  }
  /// A point between two vertices, given by their planes from the brick's first ones on; `t`: 0 at
  /// the first, 1 at the second.
  [[nodiscard]] Place between(const Coordinates<3>& first, const Coordinates<3>& second,
                              double t) const {
    const Place from = at(first), to = at(second);
    return {from.xy + t * (to.xy - from.xy), from.z + t * (to.z - from.z)};
  }

 private:
  [[nodiscard]] Place at(const Coordinates<3>& v) const {
    const Place &x = part(0, v), &y = part(1, v), &z = part(2, v);
    return {x.xy + y.xy + z.xy, x.z + y.z + z.z};
  }
  [[nodiscard]] const Place& part(std::size_t axis, const Coordinates<3>& v) const {
    return parts_[axis][static_cast<std::size_t>(v[axis])];
  }

  std::array<std::array<Place, kBrickSide + 1>, 3> parts_;
};

}  // namespace isostar
