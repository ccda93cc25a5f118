#include "scalars/intervals.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

TEST(Interval, isThatOfAMagnitudeSeenFromAnIsoStep) {
  Scalars<2>::Brick brick{};
  brick.set(0, true, 8, 3);
  brick.set(1, false, 8, 3);
  const Interval above = Interval::of(brick.value[0], 100),
                 below = Interval::of(brick.value[1], 100);
  EXPECT_EQ(above.low, 108);
  EXPECT_EQ(above.high, 116);
  EXPECT_EQ(below.low, 84);  // -1 is the first negative iso step: magnitudes 8 … 15 are -9 … -16
  EXPECT_EQ(below.high, 92);
  EXPECT_EQ(above.value(100), brick.value[0]);
  EXPECT_EQ(below.value(100), brick.value[1]);
}

TEST(Interval, isNeverEmptyAfterACut) {
  for (int32_t low = -3; low < 3; ++low) {
    for (int32_t high = low + 1; high < 4; ++high) {
      for (int32_t isoStep = -6; isoStep < 6; ++isoStep) {
        for (const bool side : {false, true}) {
          const Interval cut = Interval{low, high}.cut(isoStep, side);
          EXPECT_LT(cut.low, cut.high);
          if (side)
            EXPECT_GE(cut.low, isoStep);
          else
            EXPECT_LE(cut.high, isoStep);
        }
      }
    }
  }
}

TEST(Intervals, keepTheFirstBoundedInterval) {
  Intervals<2> intervals(3);
  ScalarBrick<2> scalars = ScalarBrick<2>::unknown();
  scalars.set(5, true, 8, 3);
  intervals.add(1, scalars, 10);
  scalars.set(5, true, 0, 0);
  scalars.set(6, false, 4, 1);
  intervals.add(1, scalars, 20);
  EXPECT_FALSE(intervals.has(0));
  const auto& brick = intervals.at(1);
  EXPECT_EQ(brick[5].low, 18);
  EXPECT_EQ(brick[5].high, 26);
  EXPECT_EQ(brick[6].low, 14);  // magnitudes 4 and 5 below 20 are -5 and -6
  EXPECT_EQ(brick[6].high, 16);
  EXPECT_FALSE(brick[7].bounded());
}

}  // namespace
}  // namespace isostar
