#include "model/inside_votes.h"

#include <algorithm>
#include <cmath>

namespace isostar::native {
namespace {

using Point = std::array<double, 3>;  // in grid steps; the ray's axis last

/// The sheets met by all rays along one axis: 1 at the first sample behind a sheet, or behind any
/// odd number of them.
class Rays {
 public:
  Rays(const CubicGrid& grid, int axis)
      : grid_(grid), axes_{(axis + 1) % 3, (axis + 2) % 3, axis}, met_(grid.count()) {
    strides_ = {1, size_t(grid.size[0]), size_t(grid.size[0]) * size_t(grid.size[1])};
  }

  void meet(const Mesh& mesh) {
    for (size_t t = 0; t < mesh.indices.size(); t += 3)
      meet({pointOf(mesh, mesh.indices[t]), pointOf(mesh, mesh.indices[t + 1]),
            pointOf(mesh, mesh.indices[t + 2])});
  }

  void vote(std::vector<int8_t>& votes) const {
    for (int v = 0; v < size(1); ++v) {
      for (int u = 0; u < size(0); ++u) vote(place(u, v, 0), votes);
    }
  }

 private:
  using Triangle = std::array<Point, 3>;

  int size(int i) const { return grid_.size[axes_[i]]; }
  size_t place(int u, int v, int w) const {
    return size_t(u) * strides_[axes_[0]] + size_t(v) * strides_[axes_[1]] +
           size_t(w) * strides_[axes_[2]];
  }

  Point pointOf(const Mesh& mesh, uint32_t vertex) const {
    const measure::Vector3 offset = measure::vertexAt(mesh.positions, vertex) - grid_.low;
    const Point steps = {offset.x / grid_.step, offset.y / grid_.step, offset.z / grid_.step};
    return {steps[axes_[0]], steps[axes_[1]], steps[axes_[2]]};
  }

  /// Where an edge meets the line of height v; both triangles beside the edge are told the same
  /// number.
  static double meeting(const Point& a, const Point& b, double v) {
    const bool swapped = b < a;
    const Point &p = swapped ? b : a, &q = swapped ? a : b;
    return p[0] + (q[0] - p[0]) * ((v - p[1]) / (q[1] - p[1]));
  }

  void meet(const Triangle& t) {
    const auto [low, high] = std::minmax({t[0][1], t[1][1], t[2][1]});
    for (int v = std::max(0, static_cast<int>(std::ceil(low))); v <= high && v < size(1); ++v) {
      std::array<double, 2> ends{};
      size_t count = 0;
      for (size_t i = 0; i < 3; ++i) {
        const Point &a = t[i], &b = t[(i + 1) % 3];
        if ((a[1] > v) != (b[1] > v)) ends[count++] = meeting(a, b, v);
      }
      if (count == 2) meetRow(t, v, std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
    }
  }

  /// The rays from `from` on and before `to`.
  void meetRow(const Triangle& t, int v, double from, double to) {
    for (int u = std::max(0, static_cast<int>(std::ceil(from))); u < to && u < size(0); ++u) {
      const double sample = std::clamp(std::ceil(depth(t, u, v)), 0.0, size(2) - 1.0);
      met_[place(u, v, static_cast<int>(sample))] ^= 1;
    }
  }

  /// Where the ray meets the triangle's plane, kept within the triangle where the plane is steep.
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
    bool sheets = false;
    for (size_t at = first; at < end; at += stride) sheets ^= met_[at] != 0;
    if (sheets) return;
    for (size_t at = first; at < end; at += stride) {
      sheets ^= met_[at] != 0;
      votes[at] = static_cast<int8_t>(votes[at] + (sheets ? 1 : -1));
    }
  }

  const CubicGrid& grid_;
  std::array<int, 3> axes_;
  std::array<size_t, 3> strides_{};
  std::vector<uint8_t> met_;
};

}  // namespace

std::vector<uint8_t> insideVotes(const Mesh& mesh, const CubicGrid& grid) {
  std::vector<int8_t> votes(grid.count());
  for (int axis = 0; axis < 3; ++axis) {
    Rays rays(grid, axis);
    rays.meet(mesh);
    rays.vote(votes);
  }
  std::vector<uint8_t> inside(votes.size());
  std::transform(votes.begin(), votes.end(), inside.begin(),
                 [](int8_t vote) { return uint8_t(vote > 0); });
  return inside;
}

}  // namespace isostar::native
