#pragma once

#include <vector>

#include "grid/signs.h"

namespace isostar::bench {

/// What the octree's encoder knows: the samples' signs, and which cells of each level have samples
/// of both.
class OctreeEncoderSide {
 public:
  OctreeEncoderSide(const Signs<3>& signs, int levels)
      : signs_(signs), mixed_(static_cast<size_t>(levels) + 1) {
    for (int level = levels; level >= 0; --level) find(level, levels);
  }

  [[nodiscard]] bool positive(const Coordinates<3>& sample) const { return signs_.at(sample); }
  /// Has the cell, named by its lowest corner, samples of both signs?
  [[nodiscard]] bool mixed(int level, const Coordinates<3>& cell) const {
    const auto& lattice = lattices_[static_cast<size_t>(level)];
    return mixed_[static_cast<size_t>(level)][place(lattice, cell)];
  }

 private:
  [[nodiscard]] static size_t place(const Lattice<3>& lattice, const Coordinates<3>& cell) {
    return (static_cast<size_t>(cell[2]) * static_cast<size_t>(lattice.last[1]) +
            static_cast<size_t>(cell[1])) *
               static_cast<size_t>(lattice.last[0]) +
           static_cast<size_t>(cell[0]);
  }
  /// From the samples on the finest level, from the children on all others.
  void find(int level, int levels);

  const Signs<3>& signs_;
  std::vector<Lattice<3>> lattices_;  // by level
  std::vector<std::vector<bool>> mixed_;
};

/// The decoder has nothing to ask.
struct OctreeDecoderSide {
  [[nodiscard]] bool positive(const Coordinates<3>&) const { return false; }
  [[nodiscard]] bool mixed(int, const Coordinates<3>&) const { return false; }
};

}  // namespace isostar::bench
