// What the coded isovalues together say of the field (§5.4): an interval for each vertex of their
// tubes.
#pragma once

#include "scalars/scalars.h"

namespace isostar {

/// An interval of iso steps. A field value's iso step is the number of whole quantization steps
/// from the first isovalue to it: 0 for the first value above the isovalue, -1 for the first one
/// that is not above.
struct Interval {
  static constexpr int32_t kFar = 1 << 29;  // stands for no bound

  int32_t low = -kFar, high = kFar;  // low ≤ iso step < high

  [[nodiscard]] bool bounded() const { return low > -kFar && high < kFar; }
  [[nodiscard]] uint32_t width() const { return static_cast<uint32_t>(high - low); }
  /// Twice the interval's middle relative to an isovalue: what Scalars store, with the same sign.
  [[nodiscard]] int32_t value(int32_t isoStep) const { return low + high - 2 * isoStep; }
  /// The part of the interval on one side of an isovalue. It is never empty, even if the input is
  /// untrusted and contradicts itself.
  [[nodiscard]] Interval cut(int32_t isoStep, bool above) const {
    if (above) return {std::max(low, isoStep), std::max(high, std::max(low, isoStep) + 1)};
    return {std::min(low, std::min(high, isoStep) - 1), std::min(high, isoStep)};
  }
  /// The interval of a scalar, `value` as Scalars store it, relative to the isovalue at `isoStep`.
  [[nodiscard]] static Interval of(int32_t value, int32_t isoStep) {
    const auto middle = static_cast<uint32_t>(std::abs(value));
    const auto low = static_cast<int32_t>((middle & (middle - 1)) / 2),
               high = low + (int32_t{1} << std::countr_zero(middle));
    const Interval interval = value > 0 ? Interval{low, high} : Interval{-high, -low};
    return {std::clamp(interval.low + isoStep, -kFar, kFar),
            std::clamp(interval.high + isoStep, -kFar, kFar)};
  }
};

/// One for each vertex of a brick.
template <int D>
using IntervalBrick = std::array<Interval, ScalarBrick<D>::kVertices>;

/// A brick exists only where scalars of an isovalue are known.
template <int D>
class Intervals : public SparseBricks<IntervalBrick<D>> {
 public:
  Intervals() = default;
  explicit Intervals(std::size_t tableSize) : SparseBricks<IntervalBrick<D>>(tableSize, {}) {}

  /// Adds the intervals of scalars relative to the isovalue at `isoStep`, at vertices without
  /// bounds.
  void add(std::size_t brickIndex, const ScalarBrick<D>& scalars, int32_t isoStep) {
    auto& brick = this->writable(brickIndex);
    for (std::size_t v = 0; v < brick.size(); ++v) {
      if (scalars.knows(v) && !brick[v].bounded())
        brick[v] = Interval::of(scalars.value[v], isoStep);
    }
  }
};

}  // namespace isostar
