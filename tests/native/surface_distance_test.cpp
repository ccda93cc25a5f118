#include "measure/surface_distance.h"

#include <gtest/gtest.h>

#include "measure/triangle_tree.h"
#include "shapes.h"

namespace isostar::native {
namespace {

using measure::surfaceDistance;

TEST(SurfaceDistance, isZeroToItself) {
  const auto found = surfaceDistance(torus(40, 30, 9), torus(40, 30, 9));
  EXPECT_NEAR(found->symmetric().max, 0, 1e-6);
}

TEST(SurfaceDistance, ofParallelPlanes) {
  const auto found = surfaceDistance(plane(7, 10, 0), plane(4, 10, 0.25));
  for (const auto& each : {found->aToB, found->bToA}) {
    EXPECT_NEAR(each.mean, 0.25, 1e-9);
    EXPECT_NEAR(each.rms, 0.25, 1e-9);
    EXPECT_NEAR(each.max, 0.25, 1e-9);
  }
}

TEST(SurfaceDistance, ofConcentricSpheres) {
  const auto found = surfaceDistance(sphere(100, 10), sphere(90, 12));
  EXPECT_NEAR(found->aToB.mean, 2, 0.01);
  EXPECT_NEAR(found->bToA.rms, 2, 0.01);
}

TEST(SurfaceDistance, tellsItsTwoDirectionsApart) {
  // Half of the wide plane hangs over: its far side is 10 away from the narrow one, whose own
  // points are all on it.
  Mesh wide = plane(20, 20, 0), narrow = plane(10, 10, 0);
  for (size_t v = 0; v < narrow.positions.size() / 3; ++v) narrow.positions[3 * v + 1] *= 2;
  const auto found = surfaceDistance(wide, narrow);
  EXPECT_NEAR(found->aToB.max, 10, 1e-6);
  EXPECT_NEAR(found->aToB.mean, 2.5, 0.01);  // half of the area, on average 5 away
  EXPECT_NEAR(found->bToA.max, 0, 1e-6);
  EXPECT_NEAR(found->symmetric().max, 10, 1e-6);
}

TEST(SurfaceDistance, weighsByAreaNotByTriangles) {
  // A finely cut copy of a tenth of the area, lifted by 1: triangles would say 0.99, area says a
  // tenth.
  Mesh mixed = plane(30, 1, 1);
  for (size_t v = 0; v < mixed.positions.size() / 3; ++v) mixed.positions[3 * v] *= 0.1f;
  Mesh rest = plane(1, 1, 0);
  for (size_t v = 0; v < 4; ++v) rest.positions[3 * v] = 0.1f + 0.9f * rest.positions[3 * v];
  EXPECT_NEAR(surfaceDistance(together(mixed, rest), plane(1, 1, 0))->aToB.mean, 0.1, 1e-3);
}

TEST(SurfaceDistance, givesTheSameNumbersAgain) {
  const Mesh a = torus(50, 20, 7), b = torus(61, 20.1, 7);
  EXPECT_EQ(surfaceDistance(a, b)->aToB.rms, surfaceDistance(a, b)->aToB.rms);
}

TEST(SurfaceDistance, ofNothingIsNothing) {
  EXPECT_FALSE(surfaceDistance({}, sphere(4, 1)));
  EXPECT_FALSE(surfaceDistance(sphere(4, 1), {}));
}

TEST(TriangleTree, agreesWithEveryTriangleAskedInTurn) {
  const measure::TriangleTree tree(together(torus(20, 10, 3), sphere(9, 2)));
  uint32_t near = 0;
  for (int i = 0; i < 500; ++i) {
    const measure::Vector3 point{i * 37 % 41 - 20.0, i * 53 % 43 - 21.0, i * 29 % 17 - 8.0};
    double best = INFINITY;
    for (size_t t = 0; t < tree.size(); ++t)
      best = std::min(best, squaredDistance(point, tree.triangle(t)));
    EXPECT_DOUBLE_EQ(tree.distance(point, near), std::sqrt(best));
    EXPECT_DOUBLE_EQ(squaredDistance(point, tree.triangle(near)), best);
  }
}

}  // namespace
}  // namespace isostar::native
