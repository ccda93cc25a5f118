// What is known of the scalars at the vertices of the finest tube (§5.3): intervals of |scalar -
// isovalue|.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "grid/tube.h"
#include "util/pool.h"

namespace isostar {

/// Magnitudes are counted in quanta of the stream. Of a vertex it is known that its magnitude lies
/// within [low, low + 2^width), low being a multiple of 2^width. Bricks exist only where scalars
/// are told.
template <int D>
class Scalars {
 public:
  static constexpr std::size_t kVertices = power(kBrickSide, D);
  static constexpr int32_t kUnknown = INT32_MIN;
  static constexpr uint64_t kLink =
      4 * sizeof(void*);  // by which a brick is found, while links are moved

  struct Brick {
    /// Twice the middle of what is possible (of [n, n + 1): 2 n + 1), negative at negative
    /// vertices. Its lowest bit that is set tells the width.
    std::array<int32_t, kVertices> value;
    std::array<VertexSet<D>, 2> members{};  // by Members: whose scalars are told here

    [[nodiscard]] bool knows(std::size_t v) const { return value[v] != kUnknown; }
    [[nodiscard]] uint32_t middle(std::size_t v) const {
      return static_cast<uint32_t>(std::abs(value[v]));
    }
    [[nodiscard]] int width(std::size_t v) const { return std::countr_zero(middle(v)); }
    [[nodiscard]] uint32_t low(std::size_t v) const { return (middle(v) & (middle(v) - 1)) / 2; }
    void set(std::size_t v, bool positive, uint32_t low, int log2Width) {
      const auto middle = static_cast<int32_t>(2 * low + (uint32_t{1} << log2Width));
      value[v] = positive ? middle : -middle;
    }
  };

  Scalars() = default;
  explicit Scalars(std::size_t brickIndices)
      : at_(brickIndices, kNone), gradient_(brickIndices, kNoGradient) {
    bricks_.add({});
    bricks_[kNone].value.fill(kUnknown);
  }

  [[nodiscard]] std::size_t tableSize() const { return at_.size(); }
  [[nodiscard]] bool has(std::size_t brickIndex) const { return at_[brickIndex] != kNone; }
  [[nodiscard]] const Brick& at(std::size_t brickIndex) const { return bricks_[at_[brickIndex]]; }
  [[nodiscard]] const Brick& nothing() const { return bricks_[kNone]; }
  Brick& writable(std::size_t brickIndex) {
    if (at_[brickIndex] == kNone) {
      at_[brickIndex] = static_cast<uint32_t>(bricks_.size());
      bricks_.add(bricks_[kNone]);
    }
    return bricks_[at_[brickIndex]];
  }
  /// The typical difference of scalars along a crossing edge of the brick, as 4 log2 of quanta.
  [[nodiscard]] int gradient(std::size_t brickIndex) const { return gradient_[brickIndex]; }
  [[nodiscard]] bool hasGradient(std::size_t brickIndex) const {
    return gradient_[brickIndex] != kNoGradient;
  }
  void setGradient(std::size_t brickIndex, int log2Quarters) {
    gradient_[brickIndex] = static_cast<uint8_t>(log2Quarters);
  }
  /// Multiplies all values by the power of two that leaves room, 2^12 at the most, and tells which.
  int magnify() {
    int32_t largest = 1;
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
      for (const int32_t value : bricks_[b].value) {
        if (value != kUnknown) largest = std::max(largest, std::abs(value));
      }
    }
    const int finer = std::clamp(std::countl_zero(static_cast<uint32_t>(largest)) - 3, 0, 12);
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
      for (int32_t& value : bricks_[b].value) {
        if (value != kUnknown) value *= 1 << finer;
      }
    }
    return finer;
  }
  [[nodiscard]] std::size_t brickCount() const { return bricks_.size(); }
  /// Bytes in use, while one more brick is made.
  [[nodiscard]] uint64_t memory() const { return memoryOf(at_.size(), bricks_.size()); }
  /// With so many bricks that know something, while one more is made.
  [[nodiscard]] static uint64_t memoryOf(uint64_t brickIndices, uint64_t bricks) {
    return brickIndices * 5 + (bricks + 2) * (sizeof(Brick) + kLink);
  }

 private:
  static constexpr uint32_t kNone = 0;  // index of the brick that knows nothing
  static constexpr uint8_t kNoGradient = 255;

  std::vector<uint32_t> at_;
  std::vector<uint8_t> gradient_;
  Pool<Brick> bricks_;
};

}  // namespace isostar
