#include "model/lost_area.h"

#include <algorithm>
#include <cmath>

#include "measure/triangle.h"

namespace isostar::native {
namespace {

/// Whether all samples of the cell around a point and of the neighbouring cells have one sign.
bool isUniform(const measure::Vector3& point, const SampleGrid& grid,
               const std::vector<float>& samples) {
  const measure::Vector3 offset = point - grid.low;
  std::array<int, 3> low, high;
  for (size_t axis = 0; axis < 3; ++axis) {
    const int cell =
        static_cast<int>(std::array{offset.x, offset.y, offset.z}[axis] / grid.steps.x);
    low[axis] = std::clamp(cell - 1, 0, grid.size[axis] - 1);
    high[axis] = std::clamp(cell + 2, 0, grid.size[axis] - 1);
  }
  size_t positive = 0, count = 0;
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      const float* row = &samples[grid.index(0, j, k)];
      for (int i = low[0]; i <= high[0]; ++i, ++count) positive += row[i] > 0;
    }
  }
  return positive == 0 || positive == count;
}

}  // namespace

double lostAreaFraction(const Mesh& mesh, const SampleGrid& grid,
                        const std::vector<float>& samples) {
  double lost = 0, all = 0;
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const auto corner = [&](size_t c) {
      return measure::vertexAt(mesh.positions, mesh.indices[t + c]);
    };
    const measure::Triangle triangle{corner(0), corner(1), corner(2)};
    const double area = triangle.area();
    all += area;
    if (isUniform(triangle.at(1.0 / 3, 1.0 / 3), grid, samples)) lost += area;
  }
  return all > 0 ? lost / all : 0;
}

}  // namespace isostar::native
