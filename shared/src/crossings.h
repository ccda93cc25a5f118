// The crossed edges of an octave: where the surface's vertices are.
#pragma once

#include <algorithm>
#include <bit>

#include "octave.h"
#include "scalar_window.h"
#include "window.h"

namespace isostar {

/// Which edges along a set of axes from the vertices of a row (of a Window, row r of its brick) are crossed; bit x for
/// the edge from vertex x. An edge along several axes is the diagonal of a face or cell that the RBMT has (§4.3): it
/// joins the vertex that is even on these axes with the one that is odd on them.
inline uint32_t crossedEdges(const Window<3>& window, int row, unsigned r, unsigned axes) {
  int evenRow = row, oddRow = row;
  for (unsigned a = 1; a < 3; ++a) {
    if ((axes >> a & 1) == 0) continue;
    const bool odd = (r >> (a == 1 ? 0 : 3) & 1) != 0;
    (odd ? evenRow : oddRow) += Window<3>::rowStride(static_cast<int>(a));
  }
  const uint32_t even = uint32_t{window.rows[evenRow]} >> Window<3>::kHalo, odd = uint32_t{window.rows[oddRow]} >> Window<3>::kHalo;
  if ((axes & 1) == 0) return even ^ odd;
  return ((even ^ odd >> 1) & 0x55) | ((even >> 1 ^ odd) & 0xAA);
}

/// The vertices of row r of a brick from which edges along a set of axes stay inside the lattice.
inline uint32_t edgesInside(const Lattice<3>& lattice, const Coordinates<3>& brick, unsigned r, unsigned axes) {
  const int32_t y = brick[1] * kBrickSide + static_cast<int32_t>(r & 7) + static_cast<int32_t>(axes >> 1 & 1);
  const int32_t z = brick[2] * kBrickSide + static_cast<int32_t>(r >> 3) + static_cast<int32_t>(axes >> 2 & 1);
  if (y > lattice.last[1] || z > lattice.last[2]) return 0;
  const int32_t count = std::clamp(lattice.last[0] - static_cast<int32_t>(axes & 1) - brick[0] * kBrickSide + 1, 0, kBrickSide);
  return (1u << count) - 1;
}

/// The two ends of an edge: offsets from vertex x of row r in lattice planes and in a ScalarWindow.
struct EdgeEnds {
  Coordinates<3> even{}, odd{};
  int evenAt = 0, oddAt = 0;

  EdgeEnds(const Coordinates<3>& brick, unsigned r, unsigned x, unsigned axes) {
    const std::array<unsigned, 3> local{x, r & 7, r >> 3};
    evenAt = oddAt = ScalarWindow<3>::index(r, static_cast<int>(x));
    for (int a = 0; a < 3; ++a) {
      even[a] = odd[a] = brick[a] * kBrickSide + static_cast<int32_t>(local[static_cast<std::size_t>(a)]);
      if ((axes >> a & 1) == 0) continue;
      const bool flipped = (local[static_cast<std::size_t>(a)] & 1) != 0;
      (flipped ? even : odd)[a] += 1;
      (flipped ? evenAt : oddAt) += ScalarWindow<3>::stride(a);
    }
  }
};

}  // namespace isostar
