#pragma once

#include <vector>

#include "grid/signs.h"

namespace isostar::bench {

/// The encoder's side: the signs of the samples, and which cells of each level have samples of both
/// signs.
class OctreeEncoderSide {
 public:
  OctreeEncoderSide(const Signs<3>& signs, int levels)
      : signs_(signs), mixed_(static_cast<size_t>(levels) + 1) {
    for (int level = levels; level >= 0; --level) find(level, levels);
  }

  [[nodiscard]] bool positive(const Coordinates<3>& sample) const { return signs_.at(sample); }
  /// Whether the cell, given by its lowest corner, has samples of both signs.
  [[nodiscard]] bool mixed(int level, const Coordinates<3>& cell) const {
    const auto& lattice = lattices_[static_cast<size_t>(level)];
    return mixed_[static_cast<size_t>(level)][index(lattice, cell)];
  }

 private:
  [[nodiscard]] static size_t index(const Lattice<3>& lattice, const Coordinates<3>& cell) {
    return (static_cast<size_t>(cell[2]) * static_cast<size_t>(lattice.last[1]) +
            static_cast<size_t>(cell[1])) *
               static_cast<size_t>(lattice.last[0]) +
           static_cast<size_t>(cell[0]);
  }
  /// Finds a level's mixed cells, from the samples on the finest level and from the children on
  /// others.
  void find(int level, int levels);

  const Signs<3>& signs_;
  std::vector<Lattice<3>> lattices_;  // by level
  std::vector<std::vector<bool>> mixed_;
};

/// The decoder's side, whose values are ignored.
struct OctreeDecoderSide {
  [[nodiscard]] bool positive(const Coordinates<3>&) const { return false; }
  [[nodiscard]] bool mixed(int, const Coordinates<3>&) const { return false; }
};

}  // namespace isostar::bench
