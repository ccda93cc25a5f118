#include "measure/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "threads/parallel_tasks.h"

namespace isostar::measure {
namespace {

constexpr size_t kFewestPoints = 50000;
constexpr size_t kChunks = 64;  // constant, so that sums do not depend on the number of threads

/// A reproducible sequence of pseudo-random numbers in [0, 1) (splitmix64).
class RandomSequence {
 public:
  explicit RandomSequence(uint64_t seed) : state_(seed) {}
  double next() {
    state_ += 0x9E3779B97F4A7C15;
    uint64_t z = state_;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
    z = (z ^ z >> 27) * 0x94D049BB133111EB;
    return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_;
};

struct Sums {
  double sum = 0, squares = 0, max = 0;
  size_t count = 0;

  void add(const Sums& other) {
    sum += other.sum;
    squares += other.squares;
    max = std::max(max, other.max);
    count += other.count;
  }
};

/// The total area of the triangles before each one in the tree's order, and of all triangles.
std::vector<double> areasBefore(const TriangleTree& tree) {
  std::vector<double> areas(tree.size() + 1);
  for (size_t t = 0; t < tree.size(); ++t) areas[t + 1] = areas[t] + tree.triangle(t).area();
  return areas;
}

/// One direction of the measurement, divided into chunks that any thread may process.
class Direction {
 public:
  Direction(const Measurable& from, const Measurable& to, size_t mostPoints)
      : mesh_(from.mesh),
        tree_(from.tree),
        to_(to.tree),
        areas_(areasBefore(from.tree)),
        chunks_(kChunks) {
    const size_t vertices = mesh_.positions.size() / 3;
    points_ = std::min(mostPoints, std::max(kFewestPoints, vertices));
    every_ = (vertices - 1) / mostPoints + 1;
    used_.resize(vertices);
    for (uint32_t vertex : mesh_.indices) used_[vertex] = 1;
  }

  void measure(size_t chunk) {
    measureVertices(chunk);
    measurePoints(chunk);
  }

  Distance result() const {
    Sums all;
    for (const Sums& chunk : chunks_) all.add(chunk);
    const double count = static_cast<double>(std::max<size_t>(1, all.count));
    return {.mean = all.sum / count, .rms = std::sqrt(all.squares / count), .max = all.max};
  }

 private:
  static size_t boundary(size_t count, size_t chunk) { return count * chunk / kChunks; }

  void measureVertices(size_t chunk) {
    uint32_t near = 0;
    for (size_t v = boundary(used_.size(), chunk); v < boundary(used_.size(), chunk + 1);
         v += every_) {
      if (used_[v])
        chunks_[chunk].max =
            std::max(chunks_[chunk].max, to_.distance(vertexAt(mesh_.positions, v), near));
    }
  }

  /// One random point in each of `points_` equal parts of the area.
  void measurePoints(size_t chunk) {
    if (areas_.back() <= 0) return;
    RandomSequence random(chunk);
    Sums& sums = chunks_[chunk];
    uint32_t near = 0;
    size_t t = 0;
    const double share = areas_.back() / static_cast<double>(points_);
    for (size_t p = boundary(points_, chunk); p < boundary(points_, chunk + 1); ++p) {
      const double at = share * (static_cast<double>(p) + random.next());
      if (t == 0)
        t = static_cast<size_t>(std::upper_bound(areas_.begin() + 1, areas_.end() - 1, at) -
                                areas_.begin()) -
            1;
      while (t + 1 < tree_.size() && areas_[t + 1] <= at) ++t;
      const double distance = to_.distance(pointIn(tree_.triangle(t), random), near);
      sums.add({.sum = distance, .squares = distance * distance, .max = distance, .count = 1});
    }
  }

  static Vector3 pointIn(const Triangle& triangle, RandomSequence& random) {
    double u = random.next(), v = random.next();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return triangle.at(u, v);
  }

  const Mesh& mesh_;
  const TriangleTree& tree_;
  const TriangleTree& to_;
  std::vector<double> areas_;
  std::vector<Sums> chunks_;
  std::vector<uint8_t> used_;
  size_t points_ = 0;
  size_t every_ = 1;  // every how many vertices one is measured
};

}  // namespace

Distance SurfaceDistance::symmetric() const {
  return {.mean = std::max(aToB.mean, bToA.mean),
          .rms = std::max(aToB.rms, bToA.rms),
          .max = std::max(aToB.max, bToA.max)};
}

Measurable::Measurable(const Mesh& measured) : mesh(measured), tree(measured) {}

SurfaceDistance surfaceDistance(const Measurable& a, const Measurable& b, size_t points) {
  Direction aToB(a, b, points), bToA(b, a, points);
  runInParallel(2 * kChunks, [&](size_t task) {
    task < kChunks ? aToB.measure(task) : bToA.measure(task - kChunks);
  });
  return {aToB.result(), bToA.result()};
}

std::optional<SurfaceDistance> surfaceDistance(const Mesh& a, const Mesh& b) {
  if (a.indices.empty() || b.indices.empty()) return {};
  std::optional<Measurable> readyA, readyB;
  runInParallel(2, [&](size_t which) { which == 0 ? readyA.emplace(a) : readyB.emplace(b); });
  return surfaceDistance(*readyA, *readyB, std::numeric_limits<size_t>::max());
}

}  // namespace isostar::measure
