// A map from brick indices to bricks that exist only where something is known.
#pragma once

#include <cstddef>
#include <cstdint>

#include "grid/brick_map.h"
#include "util/pool.h"

namespace isostar {

/// Reading never allocates: an index without a brick of its own reads as nothing().
template <class Brick>
class SparseBricks {
 public:
  /// Bytes of bookkeeping for a brick while the pool grows.
  static constexpr uint64_t kLink = 4 * sizeof(void*);
  /// The most bytes that refer() takes.
  static constexpr uint64_t kBytesToRefer = kLink + BrickMap<uint32_t, 0>::kBytesPerPage;

  SparseBricks() = default;
  /// `tableSize`: the number of bricks in the lattice's BrickTable. `nothing`: a brick in which
  /// nothing is known.
  SparseBricks(std::size_t tableSize, const Brick& nothing) : at_(tableSize) {
    bricks_.add(nothing);
  }

  [[nodiscard]] std::size_t tableSize() const { return at_.size(); }
  /// Includes nothing().
  [[nodiscard]] std::size_t brickCount() const { return bricks_.size(); }
  [[nodiscard]] bool has(std::size_t brickIndex) const { return at_[brickIndex] != kNone; }
  [[nodiscard]] const Brick& at(std::size_t brickIndex) const { return bricks_[at_[brickIndex]]; }
  [[nodiscard]] const Brick& nothing() const { return bricks_[kNone]; }
  /// The brick at an index, for writing; made if there is none. References to other bricks stay
  /// valid.
  Brick& writable(std::size_t brickIndex) {
    if (at_[brickIndex] == kNone) {
      at_.set(brickIndex, static_cast<uint32_t>(bricks_.size()));
      bricks_.add(bricks_[kNone]);
    }
    return bricks_[at_[brickIndex]];
  }
  /// Makes the brick at an index that has none one of another table's, which must outlive its use
  /// here. Both see changes.
  void refer(std::size_t brickIndex, Brick& brick) {
    at_.set(brickIndex, static_cast<uint32_t>(bricks_.size()));
    bricks_.refer(brick);
  }
  /// Calls visit(brick) for each brick, nothing() included.
  template <class Visit>
  void forEachBrick(Visit visit) {
    for (std::size_t b = 0; b < bricks_.size(); ++b) visit(bricks_[b]);
  }

  /// Bytes in use while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    return at_.memoryToSet() + memoryOfBricks(bricks_.size());
  }
  [[nodiscard]] static uint64_t memoryOf(uint64_t tableSize, uint64_t bricks) {
    return Slots::memoryOf(tableSize, bricks + 1) + memoryOfBricks(bricks);
  }

 private:
  static constexpr uint32_t kNone = 0;  // the slot of nothing()
  using Slots = BrickMap<uint32_t, kNone>;

  [[nodiscard]] static uint64_t memoryOfBricks(uint64_t bricks) {
    return (bricks + 2) * (sizeof(Brick) + kLink);
  }

  Slots at_;
  Pool<Brick> bricks_;
};

}  // namespace isostar
