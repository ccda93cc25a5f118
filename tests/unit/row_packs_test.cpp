#include "grid/row_packs.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

/// Calls visit(offset) for all offsets within ±2 on each axis.
template <int D, class Visit>
void forOffsets(Visit visit) {
  Coordinates<D> last;
  last.fill(4);
  forVertices(Lattice<D>(last, 1), [&](Coordinates<D> d) {
    for (int32_t& x : d) x -= 2;
    visit(d);
  });
}

template <int D>
void expectCounts(const Coordinates<D>& box) {
  const DenseSigns<D> dense(Lattice<D>(box, 1), signFields<D>(box)[0].positive);
  const auto signs = dense.bricks();
  Window<D> window;
  Coordinates<D> brick;
  brick.fill(1);
  window.load(signs, brick);
  for (std::size_t number = 0; number < power(kBrickSide, D); number += 7) {
    const auto v = vertexOf<D>(brick, number);
    const int at = static_cast<int>(number % kBrickSide) + Window<D>::kHalo;
    const auto packs = RowPacks<D>::around(
        &window.rows[static_cast<std::size_t>(Window<D>::kOwnRows[number / kBrickSide])]);
    RowPacks<D> everyThird;
    unsigned expected = 0, n = 0;
    forOffsets<D>([&](const Coordinates<D>& d) {
      std::array<int, D> offset;
      auto w = v;
      for (int a = 0; a < D; ++a) w[a] += offset[static_cast<std::size_t>(a)] = d[a];
      RowPacks<D> one;
      one.add(offset);
      ASSERT_EQ(packs.count(one, at), dense.at(w) ? 1u : 0u) << testing::PrintToString(d);
      if (n++ % 3 != 0) return;
      everyThird.add(offset);
      expected += dense.at(w) ? 1 : 0;
    });
    EXPECT_EQ(packs.count(everyThird, at), expected);
  }
}

TEST(RowPacks, countThePositiveVerticesOfAMask) {
  expectCounts<2>({23, 23});
  expectCounts<3>({23, 23, 23});
}

TEST(RowPacks, flipTheSignInTheMiddle) {
  RowPacks<3> packs, middle, beside;
  middle.add({0, 0, 0});
  beside.add({1, 0, 0});
  constexpr int kAt = 5;
  packs.flip(0, kAt);
  EXPECT_EQ(packs.count(middle, kAt), 0u);
  packs.flip(1, kAt);
  EXPECT_EQ(packs.count(middle, kAt), 1u);
  EXPECT_EQ(packs.count(beside, kAt), 0u);
  EXPECT_EQ(packs.count(beside, kAt - 1), 1u);
  packs.flip(1, kAt);
  EXPECT_EQ(packs.count(middle, kAt), 0u);
}

}  // namespace
}  // namespace isostar
