#include "coding/exchange/crossing_distortion.h"

#include <gtest/gtest.h>

#include "one_edge.h"

namespace isostar {
namespace {

TEST(CrossingDistortion, isZeroWhereCrossingsDoNotMove) {
  EXPECT_TRUE(CrossingDistortion<3>().empty());
  EXPECT_NEAR(oneEdge(104, 100).of(104), 0, 1e-12);
  EXPECT_NEAR(oneEdge(104, 50).of(52), 0, 1e-12);
  EXPECT_GT(oneEdge(104, 50).of(104), 1);
}

TEST(CrossingDistortion, growsSteeplyBeyondTheBound) {
  EXPECT_LT(oneEdge(100, 100, 1).of(120), 1);
  EXPECT_GT(oneEdge(100, 100, 0.1).of(120), 100);
}

TEST(CrossingDistortion, leavesRoomForTheFarEnd) {
  EXPECT_TRUE(oneEdge(100, 500).mayEndAt(104));
  EXPECT_FALSE(oneEdge(100, 500).mayEndAt(120));
}

}  // namespace
}  // namespace isostar
