#include "measure/triangle_tree.h"

#include <algorithm>
#include <cmath>

namespace isostar::measure {
namespace {

constexpr double kCurveSteps = 1 << 21;  // along each axis: 3 × 21 bits fit a 64-bit key
constexpr float kFar = INFINITY;
constexpr float kRounding = 4e-7f;       // bounds the rounding error of a coordinate
constexpr float kShortened = 1 - 1e-5f;  // compensates the rounding error of a distance

/// Inserts two zero bits between the bits of a 21-bit number.
uint64_t spread(uint64_t bits) {
  bits = (bits | bits << 32) & 0x001F00000000FFFF;
  bits = (bits | bits << 16) & 0x001F0000FF0000FF;
  bits = (bits | bits << 8) & 0x100F00F00F00F00F;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
  return (bits | bits << 2) & 0x1249249249249249;
}

}  // namespace

inline TriangleTree::Lanes TriangleTree::Fan::squaredDistances(
    const std::array<float, 3>& point) const {
  Lanes sums{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const Lanes below = low[axis] - point[axis], above = point[axis] - high[axis];
    Lanes outside = below > above ? below : above;
    outside = outside > 0 ? outside : Lanes{};
    sums += outside * outside;
  }
  return sums;
}

TriangleTree::TriangleTree(const Mesh& mesh) : triangles_(mesh.indices.size() / 3) {
  for (size_t t = 0; t < triangles_.size(); ++t) {
    for (size_t corner = 0; corner < 3; ++corner)
      std::copy_n(&mesh.positions[3 * size_t{mesh.indices[3 * t + corner]}], 3,
                  &triangles_[t][3 * corner]);
  }
  sortAlongCurve();
  buildFans();
}

Triangle TriangleTree::triangle(size_t position) const {
  const Corners& c = triangles_[position];
  return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}};
}

void TriangleTree::sortAlongCurve() {
  const auto centre = [](const Corners& c, size_t axis) {
    return double{c[axis]} + c[axis + 3] + c[axis + 6];
  };
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
  std::sort(order.begin(), order.end(),
            [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  std::vector<Corners> sorted(triangles_.size());
  order_.resize(order.size());
  for (size_t t = 0; t < order.size(); ++t) {
    order_[t] = order[t].index;
    sorted[t] = triangles_[order_[t]];
  }
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

TriangleTree::Box TriangleTree::boxAround(const Fan& fan) const {
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t child = 0; child < kFan; ++child) {
      box.low[axis] = std::min(box.low[axis], fan.low[axis][child]);
      box.high[axis] = std::max(box.high[axis], fan.high[axis][child]);
    }
  }
  return box;
}

void TriangleTree::buildFans() {
  size_t runs = kFan;
  while (runs * kRun < triangles_.size()) runs *= kFan;
  fans_.resize((runs - 1) / (kFan - 1));
  for (size_t node = fans_.size() + runs; node-- > 1;) {
    const Box box = node >= fans_.size() ? boxOfRun(node - fans_.size()) : boxAround(fans_[node]);
    Fan& parent = fans_[(node - 1) / kFan];
    for (size_t axis = 0; axis < 3; ++axis) {
      const float reach = std::max(std::abs(box.low[axis]), std::abs(box.high[axis]));
      const float rounding =
          reach < kFar ? kRounding * reach : 0;  // the box of an empty run stays infinitely far
      parent.low[axis][(node - 1) % kFan] = box.low[axis] - rounding;
      parent.high[axis][(node - 1) % kFan] = box.high[axis] + rounding;
    }
  }
}

void TriangleTree::searchRun(size_t run, const Vector3& point, double& best, uint32_t& near) const {
  const size_t end = std::min(triangles_.size(), kRun * (run + 1));
  for (size_t t = kRun * run; t < end; ++t) {
    const double found = squaredDistance(point, triangle(t));
    if (found >= best) continue;
    best = found;
    near = static_cast<uint32_t>(t);
  }
}

double TriangleTree::distance(const Vector3& point, uint32_t& near) const {
  near = std::min<uint32_t>(near, static_cast<uint32_t>(triangles_.size() - 1));
  double best = squaredDistance(point, triangle(near));
  const std::array<float, 3> rounded = {static_cast<float>(point.x), static_cast<float>(point.y),
                                        static_cast<float>(point.z)};
  struct Waiting {
    size_t node;
    float distance;
  };
  std::array<Waiting, 64> waiting;  // at most three per depth of the tree, the nearest last
  waiting[0] = {0, 0};
  for (size_t count = 1; count > 0;) {
    const Waiting at = waiting[--count];
    if (at.distance >= best) continue;
    if (at.node >= fans_.size()) {
      searchRun(at.node - fans_.size(), point, best, near);
      continue;
    }
    const Lanes distances = fans_[at.node].squaredDistances(rounded) * kShortened;
    const size_t first = count;
    for (size_t child = 0; child < kFan; ++child) {
      const Waiting next{kFan * at.node + 1 + child, distances[child]};
      if (next.distance >= best) continue;
      size_t slot = count++;
      for (; slot > first && waiting[slot - 1].distance < next.distance; --slot)
        waiting[slot] = waiting[slot - 1];
      waiting[slot] = next;
    }
  }
  return std::sqrt(best);
}

}  // namespace isostar::measure
