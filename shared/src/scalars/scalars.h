// What is known of the scalars at the vertices of the finest tube (§5.3): intervals of magnitudes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "grid/sparse_bricks.h"
#include "grid/tube.h"

namespace isostar {

/// The magnitude of each vertex lies within [low, low + 2^width) quantization steps, where low is a
/// multiple of 2^width.
template <int D>
struct ScalarBrick {
  static constexpr std::size_t kVertices = power(kBrickSide, D);
  static constexpr int32_t kUnknown = INT32_MIN;

  /// Twice the middle of the interval, in quantization steps (2 n + 1 for [n, n + 1)); negative at
  /// negative vertices. The lowest set bit determines the width.
  std::array<int32_t, kVertices> value;
  std::array<VertexSet<D>, 2> members{};  // by Members: the vertices whose scalars are coded

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

  [[nodiscard]] static ScalarBrick unknown() {
    ScalarBrick brick;
    brick.value.fill(kUnknown);
    return brick;
  }
};

/// A brick exists only where scalars are coded. Beside the bricks, each brick index has a gradient.
template <int D>
class Scalars : public SparseBricks<ScalarBrick<D>> {
 public:
  using Brick = ScalarBrick<D>;
  static constexpr std::size_t kVertices = Brick::kVertices;
  static constexpr int32_t kUnknown = Brick::kUnknown;

  Scalars() = default;
  explicit Scalars(std::size_t tableSize)
      : SparseBricks<Brick>(tableSize, Brick::unknown()), gradient_(tableSize) {}

  /// The typical difference of scalars along a crossing edge of the brick: 4 log2 of quantization
  /// steps.
  [[nodiscard]] int gradient(std::size_t brickIndex) const { return gradient_[brickIndex]; }
  [[nodiscard]] bool hasGradient(std::size_t brickIndex) const {
    return gradient_[brickIndex] != kNoGradient;
  }
  void setGradient(std::size_t brickIndex, int quarterLog2) {
    gradient_.set(brickIndex, static_cast<uint8_t>(quarterLog2));
  }
  /// The mean of all gradients; `otherwise` if there are none.
  [[nodiscard]] int meanGradient(int otherwise) const {
    int64_t sum = 0, count = 0;
    for (std::size_t brickIndex = 0; brickIndex < gradient_.size(); ++brickIndex) {
      if (!hasGradient(brickIndex)) continue;
      sum += gradient_[brickIndex];
      ++count;
    }
    return count == 0 ? otherwise : static_cast<int>(sum / count);
  }
  /// Multiplies all values by the largest power of two that they leave room for, at most 2^12, so
  /// that estimates between them are more precise. Returns its exponent. `spare`: so many more bits
  /// are left.
  int magnify(int spare = 0) {
    const int exponent = room(spare);
    scale(exponent);
    return exponent;
  }
  /// The exponent of that power of two.
  [[nodiscard]] int room(int spare = 0) const {
    int32_t largest = 1;
    for (std::size_t brickIndex = 0; brickIndex < this->tableSize(); ++brickIndex) {
      if (!this->has(brickIndex)) continue;
      for (const int32_t value : this->at(brickIndex).value) {
        if (value != kUnknown) largest = std::max(largest, std::abs(value));
      }
    }
    const int bits = std::countl_zero(static_cast<uint32_t>(largest)) - 3 - spare;
    return std::clamp(bits, 0, std::max(12 - spare, 0));
  }
  /// Multiplies all values by 2^exponent.
  void scale(int exponent) {
    this->forEachBrick([&](Brick& brick) {
      for (int32_t& value : brick.value) {
        if (value != kUnknown) value *= 1 << exponent;
      }
    });
  }
  /// Has copies of the bricks that are marked, by brick index.
  [[nodiscard]] Scalars only(const std::vector<uint8_t>& marked) const {
    Scalars some(this->tableSize());
    for (std::size_t brickIndex = 0; brickIndex < marked.size(); ++brickIndex) {
      if (marked[brickIndex] != 0 && this->has(brickIndex))
        some.writable(brickIndex) = this->at(brickIndex);
    }
    return some;
  }

  /// Bytes in use while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    return SparseBricks<Brick>::memory() + gradient_.memoryToSet();
  }
  [[nodiscard]] static uint64_t memoryOf(uint64_t tableSize, uint64_t bricks) {
    return SparseBricks<Brick>::memoryOf(tableSize, bricks) +
           Gradients::memoryOf(tableSize, bricks + 1);
  }

 private:
  static constexpr uint8_t kNoGradient = 255;
  using Gradients = BrickMap<uint8_t, kNoGradient>;

  Gradients gradient_;
};

}  // namespace isostar
