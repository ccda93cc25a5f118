#include "estimate/far_ends.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

constexpr std::size_t kRow = 4 + 8 * 4;  // vertex (4, 4, 4) of a brick
constexpr int kX = 4;
constexpr uint32_t kAllowed = 6554;  // 1/10 of an edge

FarEnds<3>::Allowed onAxes(uint32_t diagonal) {
  FarEnds<3>::Allowed allowed{};
  allowed.fill(diagonal);
  allowed[1] = allowed[2] = allowed[4] = kAllowed;
  return allowed;
}

/// The far ends of the vertex if one neighbour is known.
FarEnds<3> withNeighbour(int offset, int32_t value, bool mine, uint32_t diagonal = 0) {
  ScalarWindow<3> window;
  window.value.fill(Scalars<3>::kUnknown);
  window.value[static_cast<std::size_t>(ScalarWindow<3>::index(kRow, kX) + offset)] = value;
  FarEnds<3> ends;
  ends.setGradient(40);
  ends.find(window, kRow, kX, mine, onAxes(diagonal));
  return ends;
}

TEST(FarEnds, refineWhereACrossingMayMoveTooFar) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      const auto ends = withNeighbour(side * ScalarWindow<3>::stride(axis), -1000, true);
      EXPECT_TRUE(ends.move(1000, 512, false));
      EXPECT_FALSE(ends.move(1000, 16, false));
    }
  }
}

TEST(FarEnds, refineLessFarFromTheMiddleOfTheEdge) {
  const auto ends = withNeighbour(ScalarWindow<3>::stride(1), -1000, true);
  constexpr uint32_t kWidth = 256;
  EXPECT_TRUE(ends.move(1000, kWidth, false));
  EXPECT_FALSE(ends.move(8000, kWidth, false)) << "the crossing is next to the far end";
}

TEST(FarEnds, areStricterTowardsTheSmallEndOfAnInterval) {
  const auto ends = withNeighbour(ScalarWindow<3>::stride(0), -1000, true);
  bool differs = false;
  for (uint32_t width = 1; width < 2000; ++width) {
    const bool loose = ends.move(1000, width, false), strict = ends.move(1000, width, true);
    EXPECT_TRUE(strict || !loose) << width;
    differs = differs || (strict && !loose);
  }
  EXPECT_TRUE(differs);
}

TEST(FarEnds, ignoreNeighboursOfTheSameSignAndUnknownOnes) {
  constexpr uint32_t kWhole = 1024;  // the interval [0, 1024), whose middle is 1024 half steps
  EXPECT_FALSE(withNeighbour(1, 1000, true).move(kWhole, kWhole, true));
  EXPECT_FALSE(withNeighbour(1, -1000, false).move(kWhole, kWhole, true));
  EXPECT_FALSE(withNeighbour(1, Scalars<3>::kUnknown, true).move(kWhole, kWhole, true));
  EXPECT_FALSE(withNeighbour(1, Scalars<3>::kUnknown, false).move(kWhole, kWhole, true));
  EXPECT_TRUE(withNeighbour(1, 1000, false).move(kWhole, kWhole, true));
}

TEST(FarEnds, countDiagonalsOnRequest) {
  const int diagonal = ScalarWindow<3>::stride(0) + ScalarWindow<3>::stride(1);
  EXPECT_FALSE(withNeighbour(diagonal, -1000, true, 0).move(1000, 512, false));
  EXPECT_TRUE(withNeighbour(diagonal, -1000, true, kAllowed).move(1000, 512, false));
}

}  // namespace
}  // namespace isostar
