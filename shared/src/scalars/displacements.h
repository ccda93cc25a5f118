// How far the surface lies off where the signs alone put it, by blocks of vertices: what is told
// before any scalars.
#pragma once

#include "grid/signs.h"
#include "grid/tube.h"

namespace isostar {

/// What a pass tells: displacements of cubes with 2^log2Side vertices on a side, 1 … 3, in steps of
/// so many units.
struct DisplacementPass {
  int log2Side = 1;
  int step = 1;
};

/// One number for each block of 2^D vertices of the finest octave that has a positive end of a
/// crossing axis edge.
template <int D>
class Displacements {
 public:
  static constexpr int kSide = kBrickSide / 2;  // blocks along a brick
  static constexpr std::size_t kBlocks = power(kSide, D);
  static constexpr int kPerStep =
      64;  // units to a grid step; positive ones move the surface towards positive vertices
  static constexpr int kPlaneSlope = 5793;  // of a ShapeEstimate, to a step
  static constexpr int8_t kNone = -128;     // of a block of which nothing has been told
  using Brick = std::array<int8_t, kBlocks>;

  Displacements() = default;
  explicit Displacements(std::size_t brickIndices) : at_(brickIndices, 0), bricks_(1) {
    bricks_[0].fill(kNone);
  }

  [[nodiscard]] std::size_t tableSize() const { return at_.size(); }
  [[nodiscard]] bool has(std::size_t brickIndex) const { return at_[brickIndex] != 0; }
  [[nodiscard]] const Brick& at(std::size_t brickIndex) const { return bricks_[at_[brickIndex]]; }
  [[nodiscard]] const Brick& nothing() const { return bricks_[0]; }
  Brick& writable(std::size_t brickIndex) {
    if (at_[brickIndex] == 0) {
      at_[brickIndex] = static_cast<uint32_t>(bricks_.size());
      bricks_.push_back(bricks_[0]);
    }
    return bricks_[at_[brickIndex]];
  }
  /// Adds units to a block.
  static void move(int8_t& value, int units) {
    value = static_cast<int8_t>(std::clamp((value == kNone ? 0 : value) + units, -127, 127));
  }
  /// Of blocks' coordinates in a brick: the block.
  [[nodiscard]] static std::size_t blockAt(const Coordinates<D>& v) {
    std::size_t block = 0;
    for (int a = D - 1; a >= 0; --a) block = block * kSide + static_cast<std::size_t>(v[a]);
    return block;
  }
  /// Of vertex x in row r of a brick: its block.
  [[nodiscard]] static constexpr std::size_t block(std::size_t r, int x) {
    std::size_t block = static_cast<std::size_t>(x) / 2, stride = kSide;
    for (int a = 1; a < D; ++a, r /= kBrickSide, stride *= kSide)
      block += r % kBrickSide / 2 * stride;
    return block;
  }

  /// Bytes in use, while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    return at_.size() * sizeof(uint32_t) + memoryToGrow(bricks_);
  }
  /// With the first brick.
  [[nodiscard]] static uint64_t memoryToBegin(uint64_t brickIndices) {
    return brickIndices * sizeof(uint32_t) + 3 * sizeof(Brick);
  }

 private:
  std::vector<uint32_t> at_;  // 0: none
  std::vector<Brick> bricks_;
};

}  // namespace isostar
