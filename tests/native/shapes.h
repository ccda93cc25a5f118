#pragma once

#include <cmath>
#include <numbers>

#include "isostar/isostar.h"

namespace isostar::native {

inline void addVertex(Mesh& mesh, double x, double y, double z) {
  for (double coordinate : {x, y, z}) mesh.positions.push_back(static_cast<float>(coordinate));
}

/// A grid of n × m cells over a map (u, v) → point, seams closed where they wrap.
template <class Map>
Mesh sheet(uint32_t n, uint32_t m, bool wrapU, bool wrapV, Map map) {
  Mesh mesh;
  const uint32_t rows = n + !wrapU, columns = m + !wrapV;
  for (uint32_t i = 0; i < rows; ++i) {
    for (uint32_t j = 0; j < columns; ++j) map(mesh, double(i) / n, double(j) / m);
  }
  const auto at = [&](uint32_t i, uint32_t j) { return i % rows * columns + j % columns; };
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < m; ++j) {
      mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

inline Mesh plane(uint32_t n, double size, double height) {
  return sheet(n, n, false, false, [=](Mesh& mesh, double u, double v) {
    addVertex(mesh, u * size, v * size, height);
  });
}

inline Mesh torus(uint32_t n, double radius, double tube) {
  return sheet(n, n, true, true, [=](Mesh& mesh, double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v,
                 r = radius + tube * std::cos(b);
    addVertex(mesh, r * std::cos(a), r * std::sin(a), tube * std::sin(b));
  });
}

inline Mesh cube(double x, double y, double z, double side) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    addVertex(mesh, x + side * (corner & 1), y + side * (corner >> 1 & 1),
              z + side * (corner >> 2));
  mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return mesh;
}

inline Mesh sphere(uint32_t n, double radius) {
  // A tube with its two ends drawn to poles.
  Mesh mesh = sheet(n, 2 * n, false, true, [=](Mesh& m, double u, double v) {
    const double a = std::numbers::pi * (0.02 + 0.96 * u), b = 2 * std::numbers::pi * v;
    addVertex(m, radius * std::sin(a) * std::cos(b), radius * std::sin(a) * std::sin(b),
              radius * std::cos(a));
  });
  const uint32_t north = (n + 1) * 2 * n, south = north + 1;
  addVertex(mesh, 0, 0, radius);
  addVertex(mesh, 0, 0, -radius);
  for (uint32_t j = 0; j < 2 * n; ++j) {
    const uint32_t next = (j + 1) % (2 * n), last = n * 2 * n;
    mesh.indices.insert(mesh.indices.end(), {north, j, next});
    mesh.indices.insert(mesh.indices.end(), {south, last + next, last + j});
  }
  return mesh;
}

inline Mesh together(const Mesh& a, const Mesh& b) {
  Mesh both = a;
  const auto offset = static_cast<uint32_t>(a.positions.size() / 3);
  both.positions.insert(both.positions.end(), b.positions.begin(), b.positions.end());
  for (uint32_t vertex : b.indices) both.indices.push_back(vertex + offset);
  return both;
}

}  // namespace isostar::native
