#include "measure/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace isostar::measure {
namespace {

constexpr double kCurveSteps = 1 << 21;  // along each axis: three of them fill a 64-bit key
constexpr float kFar = INFINITY;

/// The bits of a 21-bit number, two places apart from each other.
uint64_t spread(uint64_t bits) {
  bits = (bits | bits << 32) & 0x001F00000000FFFF;
  bits = (bits | bits << 16) & 0x001F0000FF0000FF;
  bits = (bits | bits << 8) & 0x100F00F00F00F00F;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
  return (bits | bits << 2) & 0x1249249249249249;
}

}  // namespace

void TriangleTree::Box::cover(const Box& other) {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], other.low[axis]);
    high[axis] = std::max(high[axis], other.high[axis]);
  }
}

double TriangleTree::Box::squaredDistance(const Vector3& p) const {
  const double x = std::max({low[0] - p.x, p.x - high[0], 0.0});
  const double y = std::max({low[1] - p.y, p.y - high[1], 0.0});
  const double z = std::max({low[2] - p.z, p.z - high[2], 0.0});
  return x * x + y * y + z * z;
}

TriangleTree::TriangleTree(const Mesh& mesh) : triangles_(mesh.triangles.size() / 3) {
  for (size_t t = 0; t < triangles_.size(); ++t) {
    for (size_t corner = 0; corner < 3; ++corner)
      std::copy_n(&mesh.positions[3 * size_t{mesh.triangles[3 * t + corner]}], 3, &triangles_[t][3 * corner]);
  }
  sortAlongCurve();
  buildBoxes();
}

Triangle TriangleTree::triangle(size_t place) const {
  const Corners& c = triangles_[place];
  return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}};
}

void TriangleTree::sortAlongCurve() {
  const auto centre = [](const Corners& c, size_t axis) { return double{c[axis]} + c[axis + 3] + c[axis + 6]; };
  std::array<double, 3> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  for (const Corners& corners : triangles_) {
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], centre(corners, axis));
      high[axis] = std::max(high[axis], centre(corners, axis));
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-300});
  struct Keyed {
    uint64_t key;
    uint32_t index;
  };
  std::vector<Keyed> order(triangles_.size());
  for (size_t t = 0; t < order.size(); ++t) {
    uint64_t key = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double step = (centre(triangles_[t], axis) - low[axis]) / extent * (kCurveSteps - 1);
      key |= spread(static_cast<uint64_t>(step)) << axis;
    }
    order[t] = {key, static_cast<uint32_t>(t)};
  }
  std::sort(order.begin(), order.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  std::vector<Corners> sorted(triangles_.size());
  for (size_t t = 0; t < order.size(); ++t) sorted[t] = triangles_[order[t].index];
  triangles_ = std::move(sorted);
}

TriangleTree::Box TriangleTree::boxOfRun(size_t run) const {
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  const size_t end = std::min(triangles_.size(), kRun * (run + 1));
  for (size_t t = kRun * run; t < end; ++t) {
    for (size_t i = 0; i < 9; ++i) {
      box.low[i % 3] = std::min(box.low[i % 3], triangles_[t][i]);
      box.high[i % 3] = std::max(box.high[i % 3], triangles_[t][i]);
    }
  }
  return box;
}

void TriangleTree::buildBoxes() {
  leaves_ = std::bit_ceil(std::max<size_t>(1, (triangles_.size() + kRun - 1) / kRun));
  boxes_.resize(2 * leaves_);
  for (size_t run = 0; run < leaves_; ++run) boxes_[leaves_ + run] = boxOfRun(run);
  for (size_t node = leaves_ - 1; node > 0; --node) {
    boxes_[node] = boxes_[2 * node];
    boxes_[node].cover(boxes_[2 * node + 1]);
  }
}

double TriangleTree::distance(const Vector3& point, uint32_t& near) const {
  near = std::min<uint32_t>(near, static_cast<uint32_t>(triangles_.size() - 1));
  double best = squaredDistance(point, triangle(near));
  struct Waiting {
    size_t node;
    double distance;
  };
  std::array<Waiting, 64> waiting;  // one a level of the tree
  size_t count = 0;
  for (Waiting at{1, 0};;) {
    if (at.distance < best && at.node < leaves_) {
      Waiting first{2 * at.node, boxes_[2 * at.node].squaredDistance(point)};
      Waiting second{2 * at.node + 1, boxes_[2 * at.node + 1].squaredDistance(point)};
      if (second.distance < first.distance) std::swap(first, second);
      if (second.distance < best) waiting[count++] = second;
      at = first;
      continue;
    }
    if (at.distance < best) {
      const size_t begin = kRun * (at.node - leaves_), end = std::min(triangles_.size(), begin + kRun);
      for (size_t t = begin; t < end; ++t) {
        const double found = squaredDistance(point, triangle(t));
        if (found < best) {
          best = found;
          near = static_cast<uint32_t>(t);
        }
      }
    }
    if (count == 0) return std::sqrt(best);
    at = waiting[--count];
  }
}

}  // namespace isostar::measure
