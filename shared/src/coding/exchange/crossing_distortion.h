// How far the crossings around a vertex are off, by what is told of its scalar (§5.3). Only the
// encoder asks.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace isostar {

/// The crossings on the axis edges around one vertex. Errors are counted in what a pass allows.
template <int D>
class CrossingDistortion {
 public:
  struct Edge {
    double
        crossing;  // where the source's surface crosses it, from the vertex (0) to the far end (1)
    double far,
        coded;      // size of the far end's scalar, half quanta: the source's, and as it is told
    double length;  // so many times what the pass allows
    double weight;  // the squared cosine to the surface's normal: so much of an error lies across
                    // the surface
    double most;    // error; what is left is the far end's
  };

  CrossingDistortion() = default;
  /// Sizes are so much more than the middles that Scalars keep, in half quanta.
  explicit CrossingDistortion(double offset) : offset_(offset) {}
  /// At most 2 D of them.
  void add(const Edge& edge) { edges_[count_++] = edge; }
  [[nodiscard]] bool empty() const { return count_ == 0; }

  /// If Scalars kept this middle of the vertex: squares summed up by weight, and much more for what
  /// exceeds the most.
  [[nodiscard]] double of(uint32_t middle) const {
    constexpr double kExcess = 100;
    const double size = middle + offset_;
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Edge& edge = edges_[i];
      const double error = std::abs(size / (size + edge.coded) - edge.crossing) * edge.length;
      sum += edge.weight * error * error;
      if (error > edge.most) sum += kExcess * (1 + error - edge.most);
    }
    return sum;
  }
  /// May an interval end there that does not hold the truth? From its end all crossings can still
  /// be brought within what is allowed, whatever is done so to the far ends, too.
  [[nodiscard]] bool mayEndAt(uint32_t end) const {
    constexpr double kMost = 0.3;  // less than half
    const double size = end + offset_;
    for (std::size_t i = 0; i < count_; ++i) {
      const Edge& edge = edges_[i];
      if (std::abs(size / (size + edge.far) - edge.crossing) * edge.length > kMost) return false;
    }
    return true;
  }

 private:
  double offset_ = 0;
  std::array<Edge, 2 * D> edges_;
  std::size_t count_ = 0;
};

}  // namespace isostar
