#include "estimate/interpolation.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

constexpr std::size_t kRow = 3 + 8 * 4;  // vertex (2, 3, 4) of a brick
constexpr int kX = 2;

/// A window where nothing is known.
ScalarWindow<3> unknownWindow() {
  ScalarWindow<3> window;
  window.value.fill(Scalars<3>::kUnknown);
  return window;
}

/// Sets both neighbours of the vertex along an axis.
void setPair(ScalarWindow<3>& window, int axis, int32_t before, int32_t after) {
  const int here = ScalarWindow<3>::index(kRow, kX), stride = ScalarWindow<3>::stride(axis);
  window.value[static_cast<std::size_t>(here - stride)] = before;
  window.value[static_cast<std::size_t>(here + stride)] = after;
}

TEST(Interpolation, isTheMeanOfThePairsThatAreKnown) {
  auto window = unknownWindow();
  EXPECT_EQ(Interpolation<3>::of(window, kRow, kX, true).confidence, 0);
  EXPECT_EQ(Interpolation<3>::of(window, kRow, kX, true).magnitude, 0);
  setPair(window, 0, -100, 300);
  setPair(window, 2, 1000, Scalars<3>::kUnknown);
  auto found = Interpolation<3>::of(window, kRow, kX, true);
  EXPECT_EQ(found.confidence, 1);
  EXPECT_EQ(found.magnitude, 100);
  setPair(window, 1, 400, 800);
  found = Interpolation<3>::of(window, kRow, kX, true);
  EXPECT_EQ(found.confidence, 2);
  EXPECT_EQ(found.magnitude, 350);
}

TEST(Interpolation, isZeroOnTheWrongSide) {
  auto window = unknownWindow();
  setPair(window, 0, -100, 300);
  EXPECT_EQ(Interpolation<3>::of(window, kRow, kX, false).magnitude, 0);
  setPair(window, 0, 100, -300);
  EXPECT_EQ(Interpolation<3>::of(window, kRow, kX, false).magnitude, 100);
  EXPECT_EQ(Interpolation<3>::of(window, kRow, kX, true).magnitude, 0);
}

TEST(Interpolation, holdsTheLargestScalars) {
  auto window = unknownWindow();
  for (int axis = 0; axis < 3; ++axis) setPair(window, axis, INT32_MAX, INT32_MAX);
  const auto found = Interpolation<3>::of(window, kRow, kX, true);
  EXPECT_EQ(found.confidence, 3);
  EXPECT_NEAR(static_cast<double>(found.magnitude), INT32_MAX, INT32_MAX * 1e-4);
}

}  // namespace
}  // namespace isostar
