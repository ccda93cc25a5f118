#include "grid/sparse_bricks.h"

#include <gtest/gtest.h>

#include <array>

namespace isostar {
namespace {

using SmallBrick = std::array<int, 3>;
constexpr SmallBrick kNothing{-1, -1, -1};

TEST(SparseBricks, readAsNothingUntilWritten) {
  SparseBricks<SmallBrick> bricks(100, kNothing);
  EXPECT_EQ(bricks.tableSize(), 100u);
  EXPECT_EQ(bricks.brickCount(), 1u);
  EXPECT_FALSE(bricks.has(42));
  EXPECT_EQ(bricks.at(42), kNothing);
  EXPECT_EQ(bricks.brickCount(), 1u) << "reading allocates nothing";
  bricks.writable(42)[1] = 7;
  EXPECT_TRUE(bricks.has(42));
  EXPECT_EQ(bricks.at(42), (SmallBrick{-1, 7, -1}));
  EXPECT_EQ(bricks.at(41), kNothing);
  EXPECT_EQ(bricks.nothing(), kNothing);
  EXPECT_EQ(bricks.brickCount(), 2u);
}

TEST(SparseBricks, keepReferencesWhileOthersAreWritten) {
  SparseBricks<SmallBrick> bricks(1000, kNothing);
  SmallBrick& first = bricks.writable(500);
  for (std::size_t b = 0; b < 1000; ++b) bricks.writable(b)[0] = static_cast<int>(b);
  EXPECT_EQ(first[0], 500);
  EXPECT_EQ(&first, &bricks.writable(500));
  for (std::size_t b = 0; b < 1000; ++b) EXPECT_EQ(bricks.at(b)[0], static_cast<int>(b));
}

TEST(SparseBricks, visitEveryBrickAndNothing) {
  SparseBricks<SmallBrick> bricks(10, kNothing);
  bricks.writable(3)[0] = 30;
  bricks.writable(1)[0] = 10;
  int visits = 0, sum = 0;
  bricks.forEachBrick([&](SmallBrick& brick) {
    ++visits;
    sum += brick[0];
  });
  EXPECT_EQ(visits, 3);
  EXPECT_EQ(sum, 30 + 10 - 1);
}

TEST(SparseBricks, countTheMemoryOfOneMoreBrick) {
  SparseBricks<SmallBrick> bricks(10, kNothing);
  const uint64_t before = bricks.memory();
  EXPECT_GE(before, 10 * sizeof(uint32_t) + 2 * sizeof(SmallBrick));
  bricks.writable(0);
  EXPECT_EQ(bricks.memory() - before, sizeof(SmallBrick) + SparseBricks<SmallBrick>::kLink);
  bricks.writable(0);
  EXPECT_EQ(bricks.memory() - before, sizeof(SmallBrick) + SparseBricks<SmallBrick>::kLink);
}

}  // namespace
}  // namespace isostar
