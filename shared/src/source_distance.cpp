#include "source_distance.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "completion.h"
#include "octave.h"
#include "window.h"

namespace isostar {
namespace {

/// Calls visit(lattice vertex, axes) for each crossed edge along one axis or, for tetrahedra, several.
template <class Visit>
void forCrossings(const Signs<3>& signs, Visit visit) {
  const auto& lattice = signs.lattice();
  const auto active = activeBricks(signs);
  Window<3> window;
  for (std::size_t place = 0; place < active.size(); ++place) {
    if (active[place] == 0) continue;
    const auto brick = signs.table().brick(place);
    window.load(signs, brick);
    for (int r = 0; r < 64; ++r) {
      const Coordinates<3> v{brick[0] * 8, brick[1] * 8 + r % 8, brick[2] * 8 + r / 8};
      if (v[1] > lattice.last[1] || v[2] > lattice.last[2]) continue;
      const int row = Window<3>::row({0, r % 8, r / 8});
      for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0 && v[axis] == lattice.last[axis]) continue;
        const uint32_t mine = window.rows[row];
        const uint32_t theirs = axis == 0 ? mine >> 1 : window.rows[row + Window<3>::rowStride(axis)];
        const int32_t count = std::clamp(lattice.last[0] - v[0] + (axis == 0 ? 0 : 1), 0, 8);
        for (uint32_t open = (mine ^ theirs) >> Window<3>::kHalo & ((1u << count) - 1); open != 0; open &= open - 1) {
          visit(Coordinates<3>{v[0] + std::countr_zero(open), v[1], v[2]}, axis);
        }
      }
    }
  }
}

}  // namespace

uint64_t countCrossings(const Signs<3>& signs) {
  uint64_t count = 0;
  forCrossings(signs, [&](const Coordinates<3>&, int) { ++count; });
  return count;
}

double SourceDistance::rms(const Signs<3>&, const Scalars<3>&, const std::vector<uint8_t>&) const { return 0; }
double SourceDistance::largest(const Signs<3>&, const Scalars<3>&, Polygonizer) const { return 0; }

}  // namespace isostar
