#include "tetrahedra/tetrahedron_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isostar::native {
namespace {

constexpr uint32_t kLeafSize = 4;
/// As a fraction of the box: points on a face belong to the tetrahedra on both sides.
constexpr double kRounding = 1e-9;

std::array<double, 3> coordinates(const measure::Vector3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

TetrahedronTree::TetrahedronTree(const TetrahedralMesh& mesh)
    : nodes_(1), order_(mesh.tetrahedra.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  build(mesh, 0, 0, static_cast<uint32_t>(order_.size()));
}

void TetrahedronTree::build(const TetrahedralMesh& mesh, uint32_t node, uint32_t first,
                            uint32_t last) {
  Node box{.low = {INFINITY, INFINITY, INFINITY},
           .high = {-INFINITY, -INFINITY, -INFINITY},
           .first = first,
           .count = last - first};
  for (uint32_t i = first; i < last; ++i) {
    for (uint32_t point : mesh.tetrahedra[order_[i]]) {
      const auto position = coordinates(mesh.points[point]);
      for (size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], position[axis]);
        box.high[axis] = std::max(box.high[axis], position[axis]);
      }
    }
  }
  size_t longest = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    if (box.high[axis] - box.low[axis] > box.high[longest] - box.low[longest]) longest = axis;
  const double rounding = kRounding * (box.high[longest] - box.low[longest]);
  for (size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] -= rounding;
    box.high[axis] += rounding;
  }
  if (last - first > kLeafSize) {
    const auto middle = [&](uint32_t t) {
      double sum = 0;
      for (uint32_t point : mesh.tetrahedra[t]) sum += coordinates(mesh.points[point])[longest];
      return sum;
    };
    const uint32_t half = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                     [&](uint32_t a, uint32_t b) { return middle(a) < middle(b); });
    box.first = static_cast<uint32_t>(nodes_.size());
    box.count = 0;
    nodes_.resize(nodes_.size() + 2);
    build(mesh, box.first, first, half);
    build(mesh, box.first + 1, half, last);
  }
  nodes_[node] = box;
}

}  // namespace isostar::native
