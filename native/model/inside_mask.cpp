#include "model/inside_mask.h"

#include <algorithm>
#include <cmath>

namespace isostar::native {
namespace {

using Point = std::array<double, 3>;  // in grid steps; the ray's axis last

/// The intersections of the surface with all rays along one axis: 1 at a sample if an odd number of
/// intersections lies between it and the sample before.
class Rays {
 public:
  Rays(const SampleGrid& grid, int axis)
      : grid_(grid), axes_{(axis + 1) % 3, (axis + 2) % 3, axis}, crossed_(grid.count()) {
    strides_ = {1, size_t(grid.size[0]), size_t(grid.size[0]) * size_t(grid.size[1])};
  }

  void intersect(const Mesh& mesh) {
    for (size_t t = 0; t < mesh.indices.size(); t += 3)
      intersect({pointOf(mesh, mesh.indices[t]), pointOf(mesh, mesh.indices[t + 1]),
                 pointOf(mesh, mesh.indices[t + 2])});
  }

  void vote(std::vector<int8_t>& votes) const {
    for (int v = 0; v < size(1); ++v) {
      for (int u = 0; u < size(0); ++u) vote(index(u, v, 0), votes);
    }
  }

 private:
  using Triangle = std::array<Point, 3>;

  int size(int i) const { return grid_.size[axes_[i]]; }
  size_t index(int u, int v, int w) const {
    return size_t(u) * strides_[axes_[0]] + size_t(v) * strides_[axes_[1]] +
           size_t(w) * strides_[axes_[2]];
  }

  Point pointOf(const Mesh& mesh, uint32_t vertex) const {
    const measure::Vector3 p = grid_.inSteps(measure::vertexAt(mesh.positions, vertex));
    const Point steps = {p.x, p.y, p.z};
    return {steps[axes_[0]], steps[axes_[1]], steps[axes_[2]]};
  }

  /// Where an edge intersects the line of height v. The result is the same for both triangles of
  /// the edge.
  static double intersection(const Point& a, const Point& b, double v) {
    const bool swapped = b < a;
    const Point &p = swapped ? b : a, &q = swapped ? a : b;
    return p[0] + (q[0] - p[0]) * ((v - p[1]) / (q[1] - p[1]));
  }

  void intersect(const Triangle& t) {
    const auto [low, high] = std::minmax({t[0][1], t[1][1], t[2][1]});
    for (int v = std::max(0, static_cast<int>(std::ceil(low))); v <= high && v < size(1); ++v) {
      std::array<double, 2> ends{};
      size_t count = 0;
      for (size_t i = 0; i < 3; ++i) {
        const Point &a = t[i], &b = t[(i + 1) % 3];
        if ((a[1] > v) != (b[1] > v)) ends[count++] = intersection(a, b, v);
      }
      if (count == 2) intersectRow(t, v, std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
    }
  }

  /// The rays from `from` (inclusive) to `to` (exclusive).
  void intersectRow(const Triangle& t, int v, double from, double to) {
    for (int u = std::max(0, static_cast<int>(std::ceil(from))); u < to && u < size(0); ++u) {
      const double sample = std::clamp(std::ceil(depth(t, u, v)), 0.0, size(2) - 1.0);
      crossed_[index(u, v, static_cast<int>(sample))] ^= 1;
    }
  }

  /// Where the ray intersects the triangle's plane, clamped to the triangle's extent because a
  /// steep plane is ill-conditioned.
  static double depth(const Triangle& t, double u, double v) {
    const double bu = t[1][0] - t[0][0], bv = t[1][1] - t[0][1], cu = t[2][0] - t[0][0],
                 cv = t[2][1] - t[0][1];
    const double area = bu * cv - bv * cu;
    const auto [low, high] = std::minmax({t[0][2], t[1][2], t[2][2]});
    if (area == 0) return (low + high) / 2;
    const double pu = u - t[0][0], pv = v - t[0][1];
    const double b = (pu * cv - pv * cu) / area, c = (bu * pv - bv * pu) / area;
    return std::clamp(t[0][2] + b * (t[1][2] - t[0][2]) + c * (t[2][2] - t[0][2]), low, high);
  }

  void vote(size_t first, std::vector<int8_t>& votes) const {
    const size_t stride = strides_[axes_[2]], end = first + stride * size_t(size(2));
    bool inside = false;
    for (size_t at = first; at < end; at += stride) inside ^= crossed_[at] != 0;
    if (inside) return;
    for (size_t at = first; at < end; at += stride) {
      inside ^= crossed_[at] != 0;
      votes[at] = static_cast<int8_t>(votes[at] + (inside ? 1 : -1));
    }
  }

  const SampleGrid& grid_;
  std::array<int, 3> axes_;
  std::array<size_t, 3> strides_{};
  std::vector<uint8_t> crossed_;
};

}  // namespace

std::vector<uint8_t> insideMask(const Mesh& mesh, const SampleGrid& grid) {
  std::vector<int8_t> votes(grid.count());
  for (int axis = 0; axis < 3; ++axis) {
    Rays rays(grid, axis);
    rays.intersect(mesh);
    rays.vote(votes);
  }
  std::vector<uint8_t> inside(votes.size());
  std::transform(votes.begin(), votes.end(), inside.begin(),
                 [](int8_t vote) { return uint8_t(vote > 0); });
  return inside;
}

}  // namespace isostar::native
