#include "grid/tube.h"

#include <gtest/gtest.h>

#include <set>

#include "grid/simplex.h"
#include "sign_fields.h"

namespace isostar {
namespace {

template <int D>
struct Classes {
  std::set<Coordinates<D>> axisEnds, diagonalEnds;
};

/// The ends of the crossing edges of all simplices, by the definition.
template <int D>
Classes<D> byForce(const DenseSigns<D>& signs) {
  Classes<D> result;
  std::set<Coordinates<D>> all;
  const auto& lattice = signs.lattice();
  forVertices(lattice, [&](const Coordinates<D>& v) {
    for (int a = 0; a < D; ++a) {
      auto next = v;
      if (++next[a] > lattice.last[a] || signs.at(next) == signs.at(v)) continue;
      result.axisEnds.insert({v, next});
    }
  });
  for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
    const auto simplex = Simplex<D>::at(n, lattice);
    for (int i = 0; i <= D; ++i) {
      for (int j = 0; j < i; ++j) {
        if (signs.at(simplex.vertex(i)) != signs.at(simplex.vertex(j)))
          all.insert({simplex.vertex(i), simplex.vertex(j)});
      }
    }
  }
  for (const auto& v : all) {
    if (!result.axisEnds.contains(v)) result.diagonalEnds.insert(v);
  }
  return result;
}

template <int D>
std::set<Coordinates<D>> found(const Signs<D>& signs, Members members) {
  std::set<Coordinates<D>> result;
  Tube<D> tube;
  for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
    tube.enter(signs, brickIndex, members);
    bool any = false;
    tube.forEach([&](int row, std::size_t r, int x) {
      any = true;
      Coordinates<D> v;
      v[0] = tube.at()[0] * kBrickSide + x;
      std::size_t digits = r;
      for (int a = 1; a < D; ++a, digits /= kBrickSide)
        v[a] = tube.at()[a] * kBrickSide + static_cast<int32_t>(digits % kBrickSide);
      EXPECT_TRUE(result.insert(v).second);
      EXPECT_EQ(tube.positive(row, x), signs.at(v));
      unsigned odd = 0;
      for (int a = 0; a < D; ++a) odd |= static_cast<unsigned>(v[a] & 1) << a;
      EXPECT_EQ(Tube<D>::parity(r, x), odd);
    });
    EXPECT_EQ(tube.empty(), !any);
  }
  return result;
}

template <int D>
void expectTube(const Coordinates<D>& box) {
  for (const auto& field : signFields<D>(box)) {
    SCOPED_TRACE(field.name + " in " + testing::PrintToString(box));
    const DenseSigns<D> dense(Lattice<D>(box, 1), field.positive);
    const auto expected = byForce<D>(dense);
    const auto signs = dense.bricks();
    EXPECT_EQ(found<D>(signs, Members::AxisEnds), expected.axisEnds);
    EXPECT_EQ(found<D>(signs, Members::DiagonalEnds), expected.diagonalEnds);
  }
}

TEST(Tube, holdsTheEndsOfCrossingEdges) {
  expectTube<2>({1, 1});
  expectTube<2>({17, 9});
  expectTube<3>({1, 1, 1});
  expectTube<3>({8, 7, 9});
  expectTube<3>({2, 16, 5});
  expectTube<4>({3, 4, 2, 5});
}

}  // namespace
}  // namespace isostar
