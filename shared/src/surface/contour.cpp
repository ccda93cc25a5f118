// Marching squares and its counterpart on the RBMT's triangles: points on crossing edges, linked to
// polylines.
#include "surface/contour.h"

#include "scalars/crossings.h"

namespace isostar {
namespace {

/// Where the points of a brick's crossing edges are in the list of points, by set of axes, then by
/// row.
struct EdgeIndex {
  std::array<std::array<uint32_t, kBrickSide>, 4> first{};
  std::array<std::array<uint32_t, kBrickSide>, 4> crossed{};
};

class Tracing {
 public:
  static constexpr uint64_t kBytesPerEntry =
      sizeof(uint8_t) + sizeof(uint32_t);  // of active_ and slot_, per brick index

  Tracing(const Surface<2>& surface, const MeshOptions& options, Contours& out)
      : surface_(surface),
        signs_(surface.signs),
        options_(options),
        out_(out),
        active_(activeBricks(signs_)),
        slot_(active_.size()) {}

  Error run(const Limits& limits) {
    uint32_t bricks = 0;
    forActive([&](std::size_t brickIndex) { slot_[brickIndex] = bricks++; });
    const uint64_t held = kBytesPerEntry * active_.size() + bricks * uint64_t{sizeof(EdgeIndex)};
    if (held > limits.memory) return Error::OverLimit;
    index_.resize(bricks);
    bool within = true;
    forActive([&](std::size_t brickIndex) {
      if (within) countEdges(brickIndex);
      within = points_ <= std::min(limits.vertices, kMostPoints);
    });
    if (!within || held + points_ * kBytesOfPoint > limits.memory) return Error::OverLimit;
    placed_.resize(points_ * 2);
    out_.points.reserve(points_ * 2);
    next_.assign(points_, kNone);
    begins_.assign(points_, true);
    forActive([&](std::size_t brickIndex) { placePoints(brickIndex); });
    forActive([&](std::size_t brickIndex) { cutCells(brickIndex); });
    out_.positiveCorner = signs_.at({0, 0});
    for (uint32_t id = 0; id < points_; ++id) {
      if (begins_[id]) follow(id);
    }
    out_.open = static_cast<uint32_t>(out_.starts.size());
    for (uint32_t id = 0; id < points_; ++id) follow(id);
    out_.starts.push_back(static_cast<uint32_t>(out_.points.size() / 2));
    return Error::None;
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX, kDone = kNone - 1;
  /// One more brick's points can still be counted.
  static constexpr uint64_t kMostPoints = kDone - 3 * power(kBrickSide, 2);
  /// For each point: placed_, next_ and begins_, its coordinates in the result, and the start of a
  /// polyline while `starts` grows.
  static constexpr uint64_t kBytesOfPoint =
      4 * sizeof(float) + sizeof(uint32_t) + 1 + 3 * sizeof(uint32_t);

  template <class Visit>
  void forActive(Visit visit) const {
    for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
      if (active_[brickIndex] != 0) visit(brickIndex);
    }
  }
  template <class Visit>
  void forEdges(Visit visit) const {
    for (unsigned axes = 1; axes < 4; ++axes) {
      if (axes == 3 && options_.polygonizer == Polygonizer::Cubes) continue;
      for (unsigned r = 0; r < kBrickSide; ++r) visit(axes, r);
    }
  }

  void countEdges(std::size_t brickIndex) {
    const auto brick = signs_.table().brick(brickIndex);
    window_.load(signs_, brick);
    forEdges([&](unsigned axes, unsigned r) {
      const uint32_t crossed = crossedEdges(window_, Window<2>::kOwnRows[r], r, axes) &
                               edgesInside(signs_.lattice(), brick, r, axes);
      index_[slot_[brickIndex]].crossed[axes][r] = crossed;
      index_[slot_[brickIndex]].first[axes][r] = points_;
      points_ += static_cast<uint32_t>(std::popcount(crossed));
    });
  }

  void placePoints(std::size_t brickIndex) {
    const auto brick = signs_.table().brick(brickIndex);
    scalars_.load(surface_.scalars, signs_.table(), brick);
    forEdges([&](unsigned axes, unsigned r) {
      uint32_t id = index_[slot_[brickIndex]].first[axes][r];
      for (uint32_t open = index_[slot_[brickIndex]].crossed[axes][r]; open != 0;
           open &= open - 1) {
        pointAt(EdgeEnds<2>(brick, r, static_cast<unsigned>(std::countr_zero(open)), axes), id++);
      }
    });
  }

  void pointAt(const EdgeEnds<2>& ends, uint32_t id) {
    const double from = surface_.size(scalars_.value[static_cast<std::size_t>(ends.evenAt)]);
    const double to = surface_.size(scalars_.value[static_cast<std::size_t>(ends.oddAt)]);
    const double t = from + to > 0 ? from / (from + to) : 0.5;
    const auto& p = surface_.placement;
    for (int a = 0; a < 2; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      const double start = signs_.lattice().sample(a, ends.even[axis]),
                   end = signs_.lattice().sample(a, ends.odd[axis]);
      const double sample = start + t * (end - start);
      placed_[id * 2 + axis] = static_cast<float>(
          options_.frame == Frame::World ? p.origin[axis] + p.spacing[axis] * sample : sample);
    }
  }

  void cutCells(std::size_t brickIndex) {
    const auto brick = signs_.table().brick(brickIndex);
    window_.load(signs_, brick);
    for (unsigned r = 0; r < kBrickSide; ++r) {
      const uint32_t low = window_.rows[Window<2>::kOwnRows[r]],
                     high = window_.rows[Window<2>::kOwnRows[r] + 1];
      uint32_t open =
          ((low | low >> 1 | high | high >> 1) & ~(low & low >> 1 & high & high >> 1)) >>
          Window<2>::kHalo;
      for (open &= edgesInside(signs_.lattice(), brick, r, 3); open != 0; open &= open - 1) {
        const auto x = static_cast<unsigned>(std::countr_zero(open));
        const unsigned at = x + Window<2>::kHalo;
        cutCell({brick[0] * kBrickSide + static_cast<int32_t>(x),
                 brick[1] * kBrickSide + static_cast<int32_t>(r)},
                (low >> at & 3) | (high >> at & 3) << 2);
      }
    }
  }

  /// Corners are sets of axes: bit a for the far plane on axis a.
  void cutCell(const Coordinates<2>& cell, unsigned signs) {
    if (options_.polygonizer == Polygonizer::Cubes) return cutRing<4>(cell, signs, {0, 1, 3, 2});
    // From the corner with even coordinates to the opposite one along one axis after the other (see
    // Simplex).
    const unsigned even = (static_cast<unsigned>(cell[0]) & 1) |
                          (static_cast<unsigned>(cell[1]) & 1) << 1,
                   odd = even ^ 3;
    const bool turned = std::popcount(even) == 1;
    cutRing<3>(cell, signs, {even, even ^ (turned ? 2u : 1u), odd});
    cutRing<3>(cell, signs, {even, odd, even ^ (turned ? 1u : 2u)});
  }

  /// Cuts off each run of positive corners by a segment of its own. `corners` are in
  /// counter-clockwise order.
  template <std::size_t N>
  void cutRing(const Coordinates<2>& cell, unsigned signs, const std::array<unsigned, N>& corners) {
    auto positive = [&](std::size_t i) { return (signs >> corners[i % N] & 1) != 0; };
    for (std::size_t i = 0; i < N; ++i) {
      if (positive(i) || !positive(i + 1)) continue;
      std::size_t j = i + 1;
      while (positive(j + 1)) ++j;
      const uint32_t from = point(cell, corners[j % N], corners[(j + 1) % N]),
                     to = point(cell, corners[i], corners[(i + 1) % N]);
      next_[from] = to;
      begins_[to] = false;
    }
  }

  /// The number of the point between two corners of a cell.
  [[nodiscard]] uint32_t point(const Coordinates<2>& cell, unsigned a, unsigned b) const {
    const unsigned corner = a & b, axes = a ^ b;
    const int32_t x = cell[0] + static_cast<int32_t>(corner & 1),
                  y = cell[1] + static_cast<int32_t>(corner >> 1);
    const EdgeIndex& index = index_[slot_[signs_.table().index({x / kBrickSide, y / kBrickSide})]];
    const auto row = static_cast<std::size_t>(y % kBrickSide);
    return index.first[axes][row] + static_cast<uint32_t>(std::popcount(
                                        index.crossed[axes][row] & ((1u << x % kBrickSide) - 1)));
  }

  /// Appends the polyline that starts at a point, unless the point has been appended already.
  void follow(uint32_t id) {
    if (next_[id] == kDone) return;
    out_.starts.push_back(static_cast<uint32_t>(out_.points.size() / 2));
    while (id != kNone && next_[id] != kDone) {
      out_.points.insert(out_.points.end(), {placed_[id * 2], placed_[id * 2 + 1]});
      const uint32_t next = next_[id];
      next_[id] = kDone;
      id = next;
    }
  }

  const Surface<2>& surface_;
  const Signs<2>& signs_;
  MeshOptions options_;
  Contours& out_;
  std::vector<uint8_t> active_;
  std::vector<uint32_t> slot_;  // by brick index of an active brick: where it is in index_
  std::vector<EdgeIndex> index_;
  Window<2> window_;
  ScalarWindow<2> scalars_;
  uint32_t points_ = 0;
  std::vector<float> placed_;   // x, y of each point
  std::vector<uint32_t> next_;  // the point that follows each point
  std::vector<bool> begins_;    // by point: does no other point lead to it?
};

}  // namespace

Error polygonize(const Surface<2>& surface, const MeshOptions& options, const Limits& limits,
                 Contours& out) {
  out = {};
  if (Tracing::kBytesPerEntry * surface.signs.table().total() > limits.memory)
    return Error::OverLimit;
  return Tracing(surface, options, out).run(limits);
}

}  // namespace isostar
