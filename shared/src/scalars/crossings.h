// The crossing edges of a lattice: the surface has one vertex on each.
#pragma once

#include <algorithm>
#include <bit>
#include <type_traits>

#include "grid/brick_pieces.h"
#include "grid/refined_signs.h"
#include "grid/window.h"
#include "scalars/scalar_window.h"

namespace isostar {

/// The crossing edges along a set of axes from the vertices of a row. `row`: the row's number in
/// the window; `r`: its number in the brick. Bit x is the edge from vertex x. An edge along several
/// axes is the diagonal of a face or cell that the RBMT has (§4.3): it joins the vertex that is
/// even on these axes with the one that is odd on them.
template <int D>
uint32_t crossedEdges(const Window<D>& window, int row, unsigned r, unsigned axes) {
  int evenRow = row, oddRow = row;
  for (int a = 1; a < D; ++a, r /= kBrickSide) {
    if ((axes >> a & 1) == 0) continue;
    const bool odd = (r & 1) != 0;
    (odd ? evenRow : oddRow) += Window<D>::rowStride(a);
  }
  const uint32_t even = uint32_t{window.rows[evenRow]} >> Window<D>::kHalo,
                 odd = uint32_t{window.rows[oddRow]} >> Window<D>::kHalo;
  if ((axes & 1) == 0) return even ^ odd;
  return ((even ^ odd >> 1) & 0x55) | ((even >> 1 ^ odd) & 0xAA);
}

/// The vertices of row r of a brick from which an edge along a set of axes stays inside the
/// lattice; bit x is vertex x.
template <int D>
uint32_t edgesInside(const Lattice<D>& lattice, const std::type_identity_t<Coordinates<D>>& brick,
                     unsigned r, unsigned axes) {
  for (int a = 1; a < D; ++a, r /= kBrickSide) {
    if (brick[a] * kBrickSide + static_cast<int32_t>(r % kBrickSide) +
            static_cast<int32_t>(axes >> a & 1) >
        lattice.last[a])
      return 0;
  }
  const int32_t count = std::clamp(
      lattice.last[0] - static_cast<int32_t>(axes & 1) - brick[0] * kBrickSide + 1, 0, kBrickSide);
  return (1u << count) - 1;
}

/// Calls enter(brickIndex) for each marked brick of a range, then visit(brick, row, axes, crossed)
/// for each of its rows and each set of axes with crossing edges. Bit x of `crossed` is the edge
/// from vertex x. `marked`: by brick index. `diagonals`: whether to visit sets of several axes.
template <int D, class Enter, class Visit>
void forCrossedRows(const Signs<D>& signs, const std::vector<uint8_t>& marked,
                    const BrickRange& range, bool diagonals, Enter enter, Visit visit) {
  Window<D> window;
  for (std::size_t brickIndex = range.first; brickIndex < range.end; ++brickIndex) {
    if (marked[brickIndex] == 0) continue;
    const auto brick = signs.table().brick(brickIndex);
    bool interior = true;
    for (int a = 0; a < D; ++a)
      interior = interior && brick[a] * kBrickSide + kBrickSide <= signs.lattice().last[a];
    window.load(signs, brick);
    enter(brickIndex);
    for (unsigned axes = 1; axes < 1u << D; ++axes) {
      if (!diagonals && !std::has_single_bit(axes)) continue;
      for (unsigned r = 0; r < Window<D>::kOwnRows.size(); ++r) {
        const uint32_t inside = interior ? 0xFF : edgesInside(signs.lattice(), brick, r, axes);
        const uint32_t crossed = crossedEdges(window, Window<D>::kOwnRows[r], r, axes) & inside;
        if (crossed != 0) visit(brick, r, axes, crossed);
      }
    }
  }
}

/// The same for all marked bricks.
template <int D, class Enter, class Visit>
void forCrossedRows(const Signs<D>& signs, const std::vector<uint8_t>& marked, bool diagonals,
                    Enter enter, Visit visit) {
  forCrossedRows(signs, marked, BrickRange{0, marked.size()}, diagonals, enter, visit);
}

/// The number of crossing axis edges of a range's marked bricks: the vertices of marching cubes.
template <int D>
uint64_t countCrossings(const Signs<D>& signs, const std::vector<uint8_t>& marked,
                        const BrickRange& range) {
  uint64_t count = 0;
  forCrossedRows(
      signs, marked, range, false, [](std::size_t) {},
      [&](const Coordinates<D>&, unsigned, unsigned, uint32_t crossed) {
        count += static_cast<uint64_t>(std::popcount(crossed));
      });
  return count;
}
/// The same of all marked bricks.
template <int D>
uint64_t countCrossings(const Signs<D>& signs, const std::vector<uint8_t>& marked) {
  return countCrossings(signs, marked, BrickRange{0, marked.size()});
}

/// The two ends of an edge from vertex x of row r of a brick: their coordinates on the lattice, and
/// their offsets in a ScalarWindow.
template <int D>
struct EdgeEnds {
  Coordinates<D> even{}, odd{};
  int evenAt = 0, oddAt = 0;

  EdgeEnds(const Coordinates<D>& brick, unsigned r, unsigned x, unsigned axes) {
    evenAt = oddAt = ScalarWindow<D>::index(r, static_cast<int>(x));
    unsigned local = x;
    for (int a = 0; a < D; ++a) {
      even[a] = odd[a] = brick[a] * kBrickSide + static_cast<int32_t>(local);
      if ((axes >> a & 1) != 0) {
        // Without a branch, which would be mispredicted often.
        const auto isOdd = static_cast<int32_t>(local & 1);
        even[a] += isOdd;
        odd[a] += 1 - isOdd;
        evenAt += isOdd * ScalarWindow<D>::stride(a);
        oddAt += (1 - isOdd) * ScalarWindow<D>::stride(a);
      }
      local = r % kBrickSide;
      r /= kBrickSide;
    }
  }
};

}  // namespace isostar
