#pragma once

#include <algorithm>

#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// n³ cubes of side 1, six tetrahedra each (Kuhn's), with a function's values at their corners.
template <class Function>
TetrahedralMesh cubesOfTetrahedra(int n, Function value) {
  TetrahedralMesh mesh;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        mesh.points.push_back({double(i), double(j), double(k)});
        mesh.values.push_back(static_cast<float>(value(mesh.points.back())));
      }
  const auto at = [n](const std::array<int, 3>& p) {
    return static_cast<uint32_t>((p[2] * (n + 1) + p[1]) * (n + 1) + p[0]);
  };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        std::array<size_t, 3> order = {0, 1, 2};
        do {
          std::array<int, 3> p = {i, j, k};
          Corners4 corners = {at(p)};
          for (size_t c = 0; c < 3; ++c) {
            ++p[order[c]];
            corners[c + 1] = at(p);
          }
          const bool odd =
              (order[0] > order[1]) != ((order[1] > order[2]) != (order[0] > order[2]));
          if (odd) std::swap(corners[2], corners[3]);
          mesh.tetrahedra.push_back(corners);
        } while (std::next_permutation(order.begin(), order.end()));
      }
  return mesh;
}

inline TetrahedralMesh together(TetrahedralMesh a, const TetrahedralMesh& b) {
  const auto offset = static_cast<uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  a.values.insert(a.values.end(), b.values.begin(), b.values.end());
  for (Corners4 corners : b.tetrahedra) {
    for (uint32_t& corner : corners) corner += offset;
    a.tetrahedra.push_back(corners);
  }
  return a;
}

}  // namespace isostar::native
