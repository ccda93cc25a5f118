// Triangles are cut where a function is zero.
#include "surface/trim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../property/surface_checks.h"

namespace isostar {
namespace {

constexpr Limits kNone{UINT64_MAX, UINT64_MAX, UINT64_MAX};

/// n × n squares of two triangles each in the plane z = 0.
Mesh square(uint32_t n) {
  Mesh mesh;
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x) {
      mesh.positions.insert(mesh.positions.end(),
                            {static_cast<float>(x), static_cast<float>(y), 0});
      mesh.normals.insert(mesh.normals.end(), {0, 0, 1});
    }
  for (uint32_t y = 0; y < n; ++y)
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t v = y * (n + 1) + x;
      mesh.indices.insert(mesh.indices.end(), {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1});
    }
  return mesh;
}
template <class Function>
std::vector<float> valuesOn(const Mesh& mesh, Function function) {
  std::vector<float> values;
  for (uint32_t i = 0; i < verticesOf(mesh); ++i)
    values.push_back(static_cast<float>(function(pointAt(mesh.positions, i))));
  return values;
}
double area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Point a = pointAt(mesh.positions, mesh.indices[t]);
    sum += cross(minus(pointAt(mesh.positions, mesh.indices[t + 1]), a),
                 minus(pointAt(mesh.positions, mesh.indices[t + 2]), a))[2] /
           2;
  }
  return sum;
}

TEST(Trim, aLinearFunctionCutsStraight) {
  Mesh mesh = square(8);
  const auto function = [](const Point& p) { return 9.2 - p[0] - 0.5 * p[1]; };
  ASSERT_EQ(trim(valuesOn(mesh, function), kNone, mesh), Error::None);
  expectSound(mesh);
  // Beyond the line lie x > 9.2 - y / 2, from (8, 2.4) to (5.2, 8).
  EXPECT_NEAR(area(mesh), 64 - 2.8 * 5.6 / 2, 1e-4);
  const Shape shape = shapeOf(mesh);
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.euler, 1);
  expectClosed(mesh, {9, 9, 1}, [&](const Point& p) { return std::abs(function(p)) < 1e-5; });
}

TEST(Trim, keepsOrRemovesWholeMeshes) {
  const Mesh whole = square(3);
  Mesh mesh = whole;
  ASSERT_EQ(trim(std::vector<float>(16, 0.0f), kNone, mesh), Error::None);
  EXPECT_EQ(mesh.positions, whole.positions);
  EXPECT_EQ(mesh.indices, whole.indices);
  ASSERT_EQ(trim(std::vector<float>(16, -1.0f), kNone, mesh), Error::None);
  EXPECT_TRUE(mesh.positions.empty() && mesh.normals.empty() && mesh.indices.empty());
  ASSERT_EQ(trim({}, kNone, mesh), Error::None);
}

TEST(Trim, aTriangleLosesACornerOrKeepsOne) {
  for (const bool keepsCorner : {false, true}) {
    Mesh mesh{{0, 0, 0, 4, 0, 0, 0, 4, 0}, {}, {0, 1, 2}};
    const float side = keepsCorner ? 1.0f : -1.0f;
    ASSERT_EQ(trim({side, -3 * side, -side}, kNone, mesh), Error::None);
    expectSound(mesh, false);
    EXPECT_EQ(verticesOf(mesh), keepsCorner ? 3u : 4u);
    EXPECT_NEAR(area(mesh), keepsCorner ? 1.0 : 7.0, 1e-6) << "at (1, 0) and (0, 2)";
  }
}

TEST(Trim, normalsStayUnitVectors) {
  Mesh mesh{{0, 0, 0, 4, 0, 0, 0, 4, 0}, {1, 0, 0, -1, 0, 0, 0, 1, 0}, {0, 1, 2}};
  ASSERT_EQ(trim({1, -1, -2}, kNone, mesh), Error::None);
  expectSound(mesh);
}

TEST(Trim, newVerticesCountTowardsTheLimits) {
  const Mesh whole = square(20);
  const auto values = valuesOn(whole, [](const Point& p) { return 15.3 - p[0] - 0.3 * p[1]; });
  Mesh mesh = whole;
  ASSERT_EQ(trim(values, kNone, mesh), Error::None);
  const uint64_t vertices = verticesOf(mesh);
  mesh = whole;
  EXPECT_EQ(trim(values, {0, vertices - 1, UINT64_MAX}, mesh), Error::OverLimit);
  mesh = whole;
  EXPECT_EQ(trim(values, {0, vertices, UINT64_MAX}, mesh), Error::None);
  mesh = whole;
  EXPECT_EQ(trim(values, {0, vertices, 1000}, mesh), Error::OverLimit);
}

}  // namespace
}  // namespace isostar
