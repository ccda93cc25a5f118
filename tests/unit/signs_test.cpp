#include "grid/signs.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

template <int D>
void expectKept(const Coordinates<D>& box) {
  const Lattice<D> lattice(box, 1);
  for (const auto& field : signFields<D>(box)) {
    const DenseSigns<D> dense(lattice, field.positive);
    EXPECT_EQ(DenseSigns<D>(dense.bricks()), dense) << field.name;
  }
}

TEST(Signs, keepTheirValues) {
  expectKept<2>({20, 7});
  expectKept<2>({8, 16});
  expectKept<3>({9, 7, 17});
  expectKept<3>({0, 15, 3});
  expectKept<4>({8, 3, 9, 2});
}

TEST(Signs, keepTheLastValue) {
  Signs<3> signs(Lattice<3>({20, 20, 20}, 1));
  const Coordinates<3> v{9, 17, 3}, other{9, 17, 4};
  for (bool positive : {true, false, true}) {
    signs.set(v, positive);
    EXPECT_EQ(signs.at(v), positive);
    EXPECT_FALSE(signs.at(other));
  }
}

TEST(Signs, shareUniformBricks) {
  Signs<3> signs(Lattice<3>({79, 79, 79}, 1));
  const std::size_t before = signs.memory();
  signs.fill(Signs<3>::kPositive);
  EXPECT_TRUE(signs.at({79, 79, 79}));
  EXPECT_EQ(signs.memory(), before);
  signs.set({5, 5, 5}, true);
  EXPECT_EQ(signs.brickCount(), 2u) << "the sign was positive before";
  signs.set({5, 5, 5}, false);
  EXPECT_EQ(signs.brickCount(), 3u);
  EXPECT_TRUE(signs.at({4, 5, 5}));
  EXPECT_TRUE(signs.at({13, 5, 5}));
}

TEST(Signs, putSharesABrickOfOneSign) {
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

}  // namespace
}  // namespace isostar
