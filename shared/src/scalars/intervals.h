// What is known of the field itself, by all isovalues that have been told (§5.4): an interval for
// each vertex of their tubes.
#pragma once

#include "scalars/scalars.h"

namespace isostar {

/// A sample's level counts quanta from the first isovalue: 0 is the first one above it, -1 the
/// first one that is not.
struct Interval {
  static constexpr int32_t kFar = 1 << 29;  // a bound that is none

  int32_t low = -kFar, high = kFar;  // low ≤ level < high

  [[nodiscard]] bool bounded() const { return low > -kFar && high < kFar; }
  [[nodiscard]] uint32_t width() const { return static_cast<uint32_t>(high - low); }
  /// Twice its middle as seen from a level: what Scalars keep, at either sign.
  [[nodiscard]] int32_t value(int32_t isoStep) const { return low + high - 2 * isoStep; }
  /// What is left of it on one side of a level. Not nothing, whatever a stranger's stream says.
  [[nodiscard]] Interval cut(int32_t isoStep, bool above) const {
    if (above) return {std::max(low, isoStep), std::max(high, std::max(low, isoStep) + 1)};
    return {std::min(low, std::min(high, isoStep) - 1), std::min(high, isoStep)};
  }
  /// Of a magnitude as Scalars keep it, seen from a level.
  [[nodiscard]] static Interval of(int32_t value, int32_t isoStep) {
    const auto middle = static_cast<uint32_t>(std::abs(value));
    const auto low = static_cast<int32_t>((middle & (middle - 1)) / 2),
               high = low + (int32_t{1} << std::countr_zero(middle));
    const Interval interval = value > 0 ? Interval{low, high} : Interval{-high, -low};
    return {std::clamp(interval.low + isoStep, -kFar, kFar),
            std::clamp(interval.high + isoStep, -kFar, kFar)};
  }
};

/// Bricks exist only where something is known.
template <int D>
class Intervals {
 public:
  using Brick = std::array<Interval, Scalars<D>::kVertices>;

  Intervals() = default;
  explicit Intervals(std::size_t brickIndices) : at_(brickIndices, kNone) { bricks_.add({}); }

  [[nodiscard]] std::size_t tableSize() const { return at_.size(); }
  [[nodiscard]] bool has(std::size_t brickIndex) const { return at_[brickIndex] != kNone; }
  [[nodiscard]] const Brick& at(std::size_t brickIndex) const { return bricks_[at_[brickIndex]]; }
  Brick& writable(std::size_t brickIndex) {
    if (at_[brickIndex] == kNone) {
      at_[brickIndex] = static_cast<uint32_t>(bricks_.size());
      bricks_.add({});
    }
    return bricks_[at_[brickIndex]];
  }
  /// Takes over what scalars tell that count from a level, where nothing is known yet.
  void add(std::size_t brickIndex, const typename Scalars<D>::Brick& scalars, int32_t isoStep) {
    Brick& brick = writable(brickIndex);
    for (std::size_t v = 0; v < brick.size(); ++v) {
      if (scalars.knows(v) && !brick[v].bounded())
        brick[v] = Interval::of(scalars.value[v], isoStep);
    }
  }
  /// Bytes in use, while one more brick is made.
  [[nodiscard]] uint64_t memory() const { return memoryOf(at_.size(), bricks_.size()); }
  /// With so many bricks, while one more is made.
  [[nodiscard]] static uint64_t memoryOf(uint64_t brickIndices, uint64_t bricks) {
    return brickIndices * sizeof(uint32_t) + (bricks + 2) * (sizeof(Brick) + Scalars<D>::kLink);
  }
  [[nodiscard]] std::size_t brickCount() const { return bricks_.size(); }

 private:
  static constexpr uint32_t kNone = 0;  // index of the brick that knows nothing

  std::vector<uint32_t> at_;
  Pool<Brick> bricks_;
};

}  // namespace isostar
