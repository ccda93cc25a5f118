#include "scalars/crossings.h"

#include <gtest/gtest.h>

#include <set>

#include "grid/simplex.h"
#include "sign_fields.h"

namespace isostar {
namespace {

template <int D>
using Edges = std::set<std::set<Coordinates<D>>>;

/// The crossing edges of all simplices, by the definition; axis edges only unless `diagonals`.
template <int D>
Edges<D> crossedByDefinition(const DenseSigns<D>& signs, bool diagonals) {
  Edges<D> edges;
  const auto& lattice = signs.lattice();
  for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
    const auto simplex = Simplex<D>::at(n, lattice);
    for (int i = 0; i <= D; ++i) {
      for (int j = 0; j < i; ++j) {
        if (!diagonals && i - j > 1) continue;
        if (signs.at(simplex.vertex(i)) != signs.at(simplex.vertex(j)))
          edges.insert({simplex.vertex(i), simplex.vertex(j)});
      }
    }
  }
  return edges;
}

template <int D>
void expectCrossings(const Coordinates<D>& box) {
  for (const auto& field : signFields<D>(box)) {
    SCOPED_TRACE(field.name + " in " + testing::PrintToString(box));
    const DenseSigns<D> dense(Lattice<D>(box, 1), field.positive);
    const auto signs = dense.bricks();
    const std::vector<uint8_t> all(signs.table().total(), 1);
    for (const bool diagonals : {false, true}) {
      Edges<D> found;
      uint64_t count = 0;
      forCrossedRows(
          signs, all, diagonals, [](std::size_t) {},
          [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
            for (unsigned x = 0; x < kBrickSide; ++x) {
              if ((crossed >> x & 1) == 0) continue;
              const EdgeEnds<D> ends(brick, r, x, axes);
              for (int a = 0; a < D; ++a) {
                if ((axes >> a & 1) == 0) continue;
                EXPECT_EQ(ends.even[a] & 1, 0);
                EXPECT_EQ(ends.odd[a] & 1, 1);
              }
              found.insert({ends.even, ends.odd});
              ++count;
            }
          });
      EXPECT_EQ(found, crossedByDefinition<D>(dense, diagonals));
      EXPECT_EQ(count, found.size()) << "each edge is visited once";
      if (!diagonals) {
        EXPECT_EQ(countCrossings(signs, all), count);
      }
    }
  }
}

TEST(Crossings, areTheCrossingEdgesOfAllSimplices) {
  expectCrossings<2>({17, 9});
  expectCrossings<3>({1, 1, 1});
  expectCrossings<3>({8, 7, 10});
  expectCrossings<4>({3, 4, 2, 8});
}

TEST(Crossings, areCountedInMarkedBricksOnly) {
  const Signs<2> signs =
      DenseSigns<2>(Lattice<2>({15, 7}, 1), [](const auto& v) { return v[1] > 3; }).bricks();
  EXPECT_EQ(countCrossings(signs, {1, 1}), 16u);
  EXPECT_EQ(countCrossings(signs, {0, 1}), 8u);
  EXPECT_EQ(countCrossings(signs, {0, 0}), 0u);
}

}  // namespace
}  // namespace isostar
