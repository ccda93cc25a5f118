#include "bench/figure6/octree_sides.h"

namespace isostar::bench {

void OctreeEncoderSide::find(int level, int levels) {
  lattices_.resize(static_cast<size_t>(levels) + 1);
  auto& lattice = lattices_[static_cast<size_t>(level)];
  lattice = Lattice<3>(signs_.lattice().box, int32_t{1} << (levels - level));
  auto& mixed = mixed_[static_cast<size_t>(level)];
  const auto [cellsX, cellsY, cellsZ] = lattice.last;
  mixed.resize(static_cast<size_t>(cellsX) * static_cast<size_t>(cellsY) *
               static_cast<size_t>(cellsZ));
  for (int32_t z = 0; z < cellsZ; ++z) {
    for (int32_t y = 0; y < cellsY; ++y) {
      for (int32_t x = 0; x < cellsX; ++x) {
        bool any = false, all = true;
        for (int corner = 0; corner < 8; ++corner) {
          Coordinates<3> at{x, y, z};
          for (int a = 0; a < 3; ++a)
            at[a] = level == levels ? at[a] + (corner >> a & 1) : 2 * at[a] + (corner >> a & 1);
          if (level == levels) {
            const bool positive = signs_.at(at);
            any = any || positive;
            all = all && positive;
            continue;
          }
          const auto& finer = lattices_[static_cast<size_t>(level) + 1].last;
          if (at[0] >= finer[0] || at[1] >= finer[1] || at[2] >= finer[2]) continue;
          any = any || this->mixed(level + 1, at);
        }
        mixed[index(lattice, {x, y, z})] = level == levels ? any && !all : any;
      }
    }
  }
}

}  // namespace isostar::bench
