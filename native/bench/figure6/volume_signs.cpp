#include "bench/figure6/volume_signs.h"

namespace isostar::bench {

Signs<3> signsOf(const Volume& volume, double isovalue) {
  Signs<3> signs(Lattice<3>(lastSample(volume.size), 1));
  auto sample = volume.samples.begin();
  for (int32_t z = 0; z < volume.size[2]; ++z) {
    for (int32_t y = 0; y < volume.size[1]; ++y) {
      for (int32_t x = 0; x < volume.size[0]; ++x)
        signs.set({x, y, z}, double{*sample++} > isovalue);
    }
  }
  return signs;
}

int finestLevelOf(const std::array<int32_t, 3>& size) {
  constexpr int kBaseCells = 4;
  int finestLevel = 0;
  while (std::max({size[0], size[1], size[2]}) - 1 > kBaseCells << finestLevel) ++finestLevel;
  return finestLevel;
}

}  // namespace isostar::bench
