#include "tetrahedra/inner_boundary.h"

#include <cmath>

namespace isostar::native {

using measure::Vector3;

Mesh innerBoundary(const SampleGrid& grid, const Mesh& boundary) {
  const auto endOf = [](double coordinate, int size) {
    if (std::abs(coordinate) <= kOnBoundary) return 1;
    return std::abs(coordinate - (size - 1)) <= kOnBoundary ? 2 : 0;
  };
  const auto endsAt = [&](uint32_t vertex) -> std::array<int, 3> {
    const Vector3 p = grid.inSteps(measure::vertexAt(boundary.positions, vertex));
    return {endOf(p.x, grid.size[0]), endOf(p.y, grid.size[1]), endOf(p.z, grid.size[2])};
  };
  Mesh within{boundary.positions, {}, {}};
  for (size_t t = 0; t < boundary.indices.size(); t += 3) {
    const auto a = endsAt(boundary.indices[t]), b = endsAt(boundary.indices[t + 1]),
               c = endsAt(boundary.indices[t + 2]);
    bool atEnd = false;
    for (size_t axis = 0; axis < 3; ++axis)
      atEnd |= a[axis] != 0 && a[axis] == b[axis] && a[axis] == c[axis];
    if (!atEnd)
      within.indices.insert(within.indices.end(), &boundary.indices[t], &boundary.indices[t] + 3);
  }
  return within;
}

void openThinGaps(const TetrahedralField& field, const SampleGrid& grid, std::span<float> domain) {
  const double onBoundary = kOnBoundary * grid.smallestStep();
  const std::array<size_t, 3> stride = {1, size_t(grid.size[0]),
                                        size_t(grid.size[0]) * size_t(grid.size[1])};
  const auto isOnFace = [&](size_t sample) { return std::abs(domain[sample]) <= kOnBoundary; };
  uint32_t near = 0;
  size_t sample = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i, ++sample) {
        if (!isOnFace(sample)) continue;
        const std::array<int, 3> vertex = {i, j, k};
        for (size_t axis = 0; axis < 3; ++axis) {
          const size_t next = sample + stride[axis];
          if (vertex[axis] + 1 == grid.size[axis] || !isOnFace(next)) continue;
          const Vector3 middle =
              grid.at(i + 0.5 * (axis == 0), j + 0.5 * (axis == 1), k + 0.5 * (axis == 2));
          if (field.domainDistance(middle, near) >= -onBoundary) continue;
          domain[sample] = domain[next] = -static_cast<float>(kOnBoundary);
        }
      }
    }
  }
}

}  // namespace isostar::native
