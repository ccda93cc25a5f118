#include "measure/triangle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isostar::measure {
namespace {

const Triangle kTriangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

double distance(const Vector3& point, const Triangle& triangle) {
  return std::sqrt(squaredDistance(point, triangle));
}

TEST(Triangle, distanceAboveItsInside) {
  EXPECT_DOUBLE_EQ(distance({1, 1, 3}, kTriangle), 3);
}

TEST(Triangle, distanceBesideEachEdge) {
  EXPECT_DOUBLE_EQ(distance({2, -3, 4}, kTriangle), 5);
  EXPECT_DOUBLE_EQ(distance({-3, 2, 4}, kTriangle), 5);
  EXPECT_DOUBLE_EQ(distance({4, 4, 0}, kTriangle), std::sqrt(8));
}

TEST(Triangle, distanceBeyondEachCorner) {
  EXPECT_DOUBLE_EQ(distance({-3, -4, 0}, kTriangle), 5);
  EXPECT_DOUBLE_EQ(distance({7, -4, 0}, kTriangle), 5);
  EXPECT_DOUBLE_EQ(distance({-4, 7, 0}, kTriangle), 5);
}

TEST(Triangle, doesNotDependOnItsOrientation) {
  const Triangle turned{kTriangle.a, kTriangle.c, kTriangle.b};
  for (const Vector3 point : {Vector3{1, 1, 1}, Vector3{9, -2, 3}, Vector3{-1, 8, 0}})
    EXPECT_DOUBLE_EQ(distance(point, kTriangle), distance(point, turned));
}

TEST(Triangle, withoutInsideIsASegmentOrAPoint) {
  EXPECT_DOUBLE_EQ(distance({3, 2, 0}, {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}), 2);
  EXPECT_DOUBLE_EQ(distance({3, 2, 0}, {{0, 0, 0}, {0, 0, 0}, {4, 0, 0}}), 2);
  EXPECT_DOUBLE_EQ(distance({3, 4, 0}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), 5);
}

TEST(Triangle, cornersAreExactlyOnIt) {
  const Triangle odd{{0.1, 0.7, 191.3}, {0.9, 0.2, 191.9}, {0.4, 0.4, 190.7}};
  for (const Vector3& corner : {odd.a, odd.b, odd.c}) EXPECT_NEAR(distance(corner, odd), 0, 1e-13);
}

}  // namespace
}  // namespace isostar::measure
