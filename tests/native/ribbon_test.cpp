#include "measure/ribbon.h"

#include <gtest/gtest.h>

#include "measure/surface_distance.h"

namespace isostar::native {
namespace {

using measure::ribbon;
using measure::surfaceDistance;

/// One open line along x at a height, and one closed square of side 4.
Contours lineAndSquare(float y) {
  return {
      .points = {0, y, 5, y, 10, y, 20, 0, 24, 0, 24, 4, 20, 4}, .starts = {0, 3, 7}, .open = 1};
}

TEST(Ribbon, hasAStripForEachSegment) {
  const Mesh mesh = ribbon(lineAndSquare(0), 1);
  EXPECT_EQ(mesh.positions.size() / 3, 14u);
  EXPECT_EQ(mesh.indices.size() / 6, 2u + 4u);  // the square is closed, the line is not
}

TEST(Ribbon, keepsTheDistanceBetweenContours) {
  const auto found = surfaceDistance(ribbon(lineAndSquare(0), 1), ribbon(lineAndSquare(0.5), 1));
  EXPECT_NEAR(found->symmetric().max, 0.5, 1e-6);
}

TEST(Ribbon, ofNoContourIsEmpty) {
  EXPECT_TRUE(ribbon({}, 1).indices.empty());
}

}  // namespace
}  // namespace isostar::native
