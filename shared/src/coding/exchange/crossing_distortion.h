// By how much the crossings around a vertex are off if its scalar is coded as a given value (§5.3).
// Used by the encoder only.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace isostar {

/// The crossings on the axis edges around one vertex. The unit of errors is what a pass allows.
template <int D>
class CrossingDistortion {
 public:
  struct Edge {
    double crossing;  // of the source's surface, from the vertex (0) to the far end (1)
    double far;       // |scalar| at the far end, in half quantization steps: the source's,
    double coded;     // and as it is or will be coded
    double length;    // of the edge, in units of what the pass allows
    double weight;    // squared cosine of the angle to the surface's normal: the part of an error
                      // that lies across the surface
    double most;      // the error that this vertex may cause; the rest is left to the far end
  };

  CrossingDistortion() = default;
  /// `offset`: the difference between a scalar's size and the middle that Scalars store, in half
  /// quantization steps.
  explicit CrossingDistortion(double offset) : offset_(offset) {}
  /// At most 2 D edges.
  void add(const Edge& edge) { edges_[count_++] = edge; }
  [[nodiscard]] bool empty() const { return count_ == 0; }

  /// The distortion if Scalars stored this middle for the vertex: the weighted sum of squared
  /// errors, plus a large penalty for each error above its `most`.
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
  /// May an interval that does not hold the actual value end here? From its end all crossings must
  /// still be within what is allowed, even if the far ends deviate likewise.
  [[nodiscard]] bool mayEndAt(uint32_t end) const {
    constexpr double kMost = 0.3;  // less than half, since both ends may deviate
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
