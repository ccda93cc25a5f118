#include "grid/signs.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

template <int D>
void expectBricksLikeDense(const Coordinates<D>& box) {
  const Lattice<D> lattice(box, 1);
  for (const auto& field : signFields<D>(box)) {
    const DenseSigns<D> dense(lattice, field.positive);
    EXPECT_EQ(DenseSigns<D>(dense.bricks()), dense) << field.name;
  }
}

TEST(Bricks, keepWhatIsSet) {
  expectBricksLikeDense<2>({20, 7});
  expectBricksLikeDense<2>({8, 16});
  expectBricksLikeDense<3>({9, 7, 17});
  expectBricksLikeDense<3>({0, 15, 3});
  expectBricksLikeDense<4>({8, 3, 9, 2});
}

TEST(Bricks, lastWordCounts) {
  Signs<3> signs(Lattice<3>({20, 20, 20}, 1));
  const Coordinates<3> v{9, 17, 3}, other{9, 17, 4};
  for (bool positive : {true, false, true}) {
    signs.set(v, positive);
    EXPECT_EQ(signs.at(v), positive);
    EXPECT_FALSE(signs.at(other));
  }
}

TEST(Bricks, uniformOnesAreShared) {
  Signs<3> signs(Lattice<3>({79, 79, 79}, 1));
  const std::size_t before = signs.memory();
  signs.fill(Signs<3>::kPositive);
  EXPECT_TRUE(signs.at({79, 79, 79}));
  EXPECT_EQ(signs.memory(), before);
  signs.set({5, 5, 5}, true);
  EXPECT_EQ(signs.brickCount(), 2u) << "nothing was changed";
  signs.set({5, 5, 5}, false);
  EXPECT_EQ(signs.brickCount(), 3u);
  EXPECT_TRUE(signs.at({4, 5, 5}));
  EXPECT_TRUE(signs.at({13, 5, 5}));
}

TEST(Bricks, putSharesABrickOfOneSign) {
  Signs<2> signs(Lattice<2>({15, 15}, 1));
  Brick<2> brick;
  brick.rows.fill(0xFF);
  signs.put(3, brick);
  EXPECT_EQ(signs.slot(3), Signs<2>::kPositive);
  brick.rows.fill(0);
  signs.put(3, brick);
  EXPECT_EQ(signs.slot(3), Signs<2>::kNegative);
  brick.rows[2] = 4;
  signs.put(3, brick);
  EXPECT_TRUE(signs.at({10, 10}));
  EXPECT_FALSE(signs.at({11, 10}));
}

TEST(Bricks, placesAreNumberedWithoutGaps) {
  const BrickTable<3> table(Lattice<3>({16, 7, 30}, 1));
  EXPECT_EQ(table.count(0), 3);
  EXPECT_EQ(table.count(1), 1);
  EXPECT_EQ(table.count(2), 4);
  EXPECT_EQ(table.total(), 12u);
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex)
    EXPECT_EQ(table.index(table.brick(brickIndex)), brickIndex);
}

}  // namespace
}  // namespace isostar
