#include "grid/brick_table.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

TEST(BrickTable, numbersBricksWithoutGaps) {
  const BrickTable<3> table(Lattice<3>({16, 7, 30}, 1));
  EXPECT_EQ(table.count(0), 3);
  EXPECT_EQ(table.count(1), 1);
  EXPECT_EQ(table.count(2), 4);
  EXPECT_EQ(table.total(), 12u);
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex)
    EXPECT_EQ(table.index(table.brick(brickIndex)), brickIndex);
}

TEST(BrickTable, findsTheBricksAround) {
  const BrickTable<2> table(Lattice<2>({31, 17}, 1));
  ASSERT_EQ(table.total(), 12u);
  constexpr auto kNowhere = BrickTable<2>::kNowhere;
  EXPECT_EQ(table.around({1, 1}), (std::array<std::size_t, 9>{0, 1, 2, 4, 5, 6, 8, 9, 10}));
  EXPECT_EQ(table.around({0, 0}), (std::array<std::size_t, 9>{kNowhere, kNowhere, kNowhere,
                                                              kNowhere, 0, 1, kNowhere, 4, 5}));
  EXPECT_EQ(table.around({3, 2}), (std::array<std::size_t, 9>{6, 7, kNowhere, 10, 11, kNowhere,
                                                              kNowhere, kNowhere, kNowhere}));
}

}  // namespace
}  // namespace isostar
