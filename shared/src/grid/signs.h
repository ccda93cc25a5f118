// The signs of a level's vertices, in bricks that exist only near the surface.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "grid/brick_map.h"
#include "grid/brick_table.h"

namespace isostar {

/// 8^D signs. Bit x of byte r is vertex (x, y, …), where r = y + 8 z + …; in 3D a brick fills one
/// cache line.
template <int D>
struct Brick {
  std::array<uint8_t, power(kBrickSide, D - 1)> rows;
  friend bool operator==(const Brick&, const Brick&) = default;
};

/// A sign for every vertex of a lattice; also used as a set of vertices, the positive ones. All
/// bricks that are wholly negative or positive share slots 0 and 1.
template <int D>
class Signs {
 public:
  static constexpr uint32_t kNegative = 0, kPositive = 1;
  /// Slots of so many consecutive bricks are stored together.
  static constexpr std::size_t kPage = BrickMap<uint32_t, kNegative, kPositive>::kPage;

  Signs() = default;
  explicit Signs(const Lattice<D>& lattice)
      : lattice_(lattice), table_(lattice), at_(table_.total()), bricks_(2) {
    // Less code than std::array::fill() in WebAssembly.
    std::memset(bricks_[kNegative].rows.data(), 0x00, sizeof bricks_[kNegative].rows);
    std::memset(bricks_[kPositive].rows.data(), 0xFF, sizeof bricks_[kPositive].rows);
  }

  [[nodiscard]] const Lattice<D>& lattice() const { return lattice_; }
  [[nodiscard]] const BrickTable<D>& table() const { return table_; }
  [[nodiscard]] uint32_t slot(std::size_t brickIndex) const { return at_[brickIndex]; }
  [[nodiscard]] const Brick<D>& brick(uint32_t index) const { return bricks_[index]; }
  [[nodiscard]] const Brick<D>& brickAt(std::size_t brickIndex) const {
    return bricks_[at_[brickIndex]];
  }
  [[nodiscard]] uint32_t brickCount() const { return static_cast<uint32_t>(bricks_.size()); }
  /// Bytes in use while one more brick is made.
  [[nodiscard]] uint64_t memory() const { return at_.memoryToSet() + memoryToGrow(bricks_); }
  /// Bytes needed at most to put that many bricks one after the other. `pages`: as of varied(), at
  /// most.
  [[nodiscard]] static uint64_t memoryToFill(uint64_t tableSize, uint64_t bricks,
                                             uint64_t pages = UINT64_MAX) {
    return Slots::memoryOf(tableSize, pages) +
           3 * (std::min(bricks, tableSize) + 2) * sizeof(Brick<D>);
  }
  /// How many pages of slots are in memory, or would be if bricks moved.
  [[nodiscard]] std::size_t varied() const { return at_.varied(); }

  void fill(uint32_t uniform) { at_.fill(uniform); }
  void setUniform(std::size_t brickIndex, uint32_t uniform) { at_.set(brickIndex, uniform); }

  /// The brick at an index, for writing. A uniform brick gets a slot of its own first.
  Brick<D>& writable(std::size_t brickIndex) {
    uint32_t index = at_[brickIndex];
    if (index <= kPositive) {
      bricks_.push_back(bricks_[index]);
      index = brickCount() - 1;
      at_.set(brickIndex, index);
    }
    return bricks_[index];
  }
  /// Sets the brick at an index. A uniform brick takes a shared slot.
  void put(std::size_t brickIndex, const Brick<D>& brick) {
    if (brick == bricks_[kNegative]) {
      at_.set(brickIndex, kNegative);
    } else if (brick == bricks_[kPositive]) {
      at_.set(brickIndex, kPositive);
    } else if (at_[brickIndex] > kPositive) {
      bricks_[at_[brickIndex]] = brick;
    } else {
      at_.set(brickIndex, brickCount());
      bricks_.push_back(brick);
    }
  }

  [[nodiscard]] bool at(const Coordinates<D>& v) const {
    return (brickAt(table_.brickIndexOf(v)).rows[rowOf(v)] >> (v[0] & 7) & 1) != 0;
  }
  void set(const Coordinates<D>& v, bool positive) {
    if (at(v) == positive) return;
    writable(table_.brickIndexOf(v)).rows[rowOf(v)] ^= static_cast<uint8_t>(1u << (v[0] & 7));
  }

 private:
  using Slots = BrickMap<uint32_t, kNegative, kPositive>;

  [[nodiscard]] static std::size_t rowOf(const Coordinates<D>& v) {
    std::size_t row = 0;
    for (int a = D - 1; a >= 1; --a) row = row * 8 + static_cast<std::size_t>(v[a] & 7);
    return row;
  }

  Lattice<D> lattice_;
  BrickTable<D> table_;
  Slots at_;
  std::vector<Brick<D>> bricks_;
};

/// How many members a set of vertices has.
template <int D>
uint64_t countMembers(const Signs<D>& set) {
  uint64_t sum = 0;
  for (std::size_t brickIndex = 0; brickIndex < set.table().total(); ++brickIndex) {
    if (set.slot(brickIndex) == Signs<D>::kNegative) continue;
    for (const uint8_t row : set.brickAt(brickIndex).rows)
      sum += static_cast<unsigned>(std::popcount(row));
  }
  return sum;
}

/// Calls visit(v) for each member of a set of vertices, which are its positive ones. `visit` may
/// change the sign of v itself.
template <int D, class Visit>
void forEachMember(const Signs<D>& set, Visit visit) {
  for (std::size_t brickIndex = 0; brickIndex < set.table().total(); ++brickIndex) {
    if (set.slot(brickIndex) == Signs<D>::kNegative) continue;
    const auto brick = set.table().brick(brickIndex);
    for (std::size_t r = 0; r < power(kBrickSide, D - 1); ++r) {
      for (uint32_t open = set.brickAt(brickIndex).rows[r]; open != 0; open &= open - 1) {
        visit(
            vertexOf<D>(brick, r * kBrickSide + static_cast<std::size_t>(std::countr_zero(open))));
      }
    }
  }
}

}  // namespace isostar
