// Checks that hold for every mesh that the codec makes.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "sampled_field.h"

namespace isostar {

using Point = std::array<double, 3>;

inline Point pointAt(const std::vector<float>& values, uint32_t i) {
  return {values[std::size_t{i} * 3], values[std::size_t{i} * 3 + 1],
          values[std::size_t{i} * 3 + 2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline uint32_t verticesOf(const Mesh& mesh) {
  return static_cast<uint32_t>(mesh.positions.size() / 3);
}

/// Complete triples, finite numbers, valid indices, unit normals, three different vertices in each
/// triangle.
inline void expectSound(const Mesh& mesh, bool normals = true) {
  ASSERT_EQ(mesh.positions.size() % 3, 0u);
  ASSERT_EQ(mesh.indices.size() % 3, 0u);
  ASSERT_EQ(mesh.normals.size(), normals ? mesh.positions.size() : 0u);
  for (float v : mesh.positions) ASSERT_TRUE(std::isfinite(v));
  for (uint32_t i = 0; normals && i < verticesOf(mesh); ++i) {
    const Point n = pointAt(mesh.normals, i);
    ASSERT_NEAR(dot(n, n), 1, 1e-5) << "normal " << i;
  }
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
    ASSERT_LT(std::max({a, b, c}), verticesOf(mesh));
    ASSERT_TRUE(a != b && b != c && c != a) << "triangle " << t / 3;
  }
}

/// For a mesh in the frame of the grid: each edge has two triangles that run along it in opposite
/// directions, or one where both ends lie at the box or ends(point) holds for both.
template <class Ends>
void expectClosed(const Mesh& mesh, const Size& size, Ends ends) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    for (std::size_t i = 0; i < 3; ++i)
      ++edges[{mesh.indices[t + i], mesh.indices[t + (i + 1) % 3]}];
  }
  for (const auto& [edge, times] : edges) {
    ASSERT_EQ(times, 1) << "edge " << edge.first << " " << edge.second;
    if (edges.contains({edge.second, edge.first})) continue;
    const Point a = pointAt(mesh.positions, edge.first), b = pointAt(mesh.positions, edge.second);
    bool atTheBox = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double wall : {0.0, size[axis] - 1.0})
        atTheBox = atTheBox || (a[axis] == wall && b[axis] == wall);
    }
    ASSERT_TRUE(atTheBox || (ends(a) && ends(b))) << "edge at " << testing::PrintToString(a);
  }
}

inline void expectClosed(const Mesh& mesh, const Size& size) {
  expectClosed(mesh, size, [](const Point&) { return false; });
}

/// For a smooth surface: its triangles are counter-clockwise seen from the side of their normals.
/// Slivers less than `height` high are skipped: where vertices may move by half of that, slivers
/// may be reversed.
inline void expectNormalsOnTheOuterSide(const Mesh& mesh, double height) {
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Point a = pointAt(mesh.positions, mesh.indices[t]),
                b = pointAt(mesh.positions, mesh.indices[t + 1]),
                c = pointAt(mesh.positions, mesh.indices[t + 2]);
    const Point flipped = cross(minus(b, a), minus(c, a));
    double longest = 0;
    for (const Point& side : {minus(b, a), minus(c, b), minus(a, c)})
      longest = std::max(longest, std::sqrt(dot(side, side)));
    if (std::sqrt(dot(flipped, flipped)) < height * longest) continue;
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_GT(dot(flipped, pointAt(mesh.normals, mesh.indices[t + i])), 0)
          << "triangle " << t / 3;
  }
}

/// Components of vertices that have a triangle, and V - E + F.
struct Shape {
  int components = 0;
  int64_t euler = 0;
};
inline Shape shapeOf(const Mesh& mesh) {
  std::vector<uint32_t> parent(verticesOf(mesh));
  std::iota(parent.begin(), parent.end(), 0u);
  auto root = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  std::vector<bool> used(parent.size());
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      const uint32_t a = mesh.indices[t + i], b = mesh.indices[t + (i + 1) % 3];
      edges[std::minmax(a, b)] = 1;
      parent[root(a)] = root(b);
      used[a] = true;
    }
  }
  Shape shape;
  shape.euler = static_cast<int64_t>(mesh.indices.size() / 3) - static_cast<int64_t>(edges.size());
  for (uint32_t v = 0; v < parent.size(); ++v) {
    if (!used[v]) continue;
    ++shape.euler;
    shape.components += root(v) == v;
  }
  return shape;
}

/// The largest distance of two vertices with the same number, both in the frame of the grid, in
/// steps along the smallest spacing.
inline double furthest(const Mesh& a, const Mesh& b, const Placement& placement) {
  const double unit = std::min({placement.spacing[0], placement.spacing[1], placement.spacing[2]});
  double most = 0;
  for (uint32_t i = 0; i < verticesOf(a); ++i) {
    Point d = minus(pointAt(a.positions, i), pointAt(b.positions, i));
    for (std::size_t axis = 0; axis < 3; ++axis) d[axis] *= placement.spacing[axis] / unit;
    most = std::max(most, std::sqrt(dot(d, d)));
  }
  return most;
}

}  // namespace isostar
