// Signs of an octave's vertices, kept in bricks that exist only near the surface.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/lattice.h"

namespace isostar {

inline constexpr int kBrickSide = 8;

constexpr std::size_t power(std::size_t base, int exponent) {
  std::size_t value = 1;
  for (int i = 0; i < exponent; ++i) value *= base;
  return value;
}

/// Bytes that a vector uses while it takes one more: where it is full, it and its successor.
template <class T>
uint64_t memoryToGrow(const std::vector<T>& v) {
  return uint64_t{v.size() < v.capacity() ? v.capacity() : 3 * v.capacity()} * sizeof(T);
}

/// 8^D signs; bit x of byte r is vertex (x, y, …) with r = y + 8 z + …: in 3D one cache line.
template <int D>
struct Brick {
  std::array<uint8_t, power(kBrickSide, D - 1)> rows;
  friend bool operator==(const Brick&, const Brick&) = default;
};

/// A vertex by its brick and its number there.
template <int D>
Coordinates<D> vertexOf(const Coordinates<D>& brick, std::size_t number) {
  Coordinates<D> v;
  for (int a = 0; a < D; ++a, number /= kBrickSide)
    v[a] = brick[a] * kBrickSide + static_cast<int32_t>(number % kBrickSide);
  return v;
}

/// Of a vertex: its number in the brick that it lies in.
template <int D>
std::size_t numberOf(const Coordinates<D>& v) {
  std::size_t number = 0;
  for (int a = D - 1; a >= 0; --a)
    number = number * kBrickSide + static_cast<std::size_t>(v[a] & (kBrickSide - 1));
  return number;
}

/// A brick's place among bricks, and in the table.
template <int D>
class BrickTable {
 public:
  BrickTable() = default;
  explicit BrickTable(const Lattice<D>& lattice) {
    size_t total = 1;
    for (int a = 0; a < D; ++a) {
      count_[a] = lattice.last[a] / kBrickSide + 1;
      stride_[a] = total;
      total *= static_cast<std::size_t>(count_[a]);
    }
    total_ = total;
  }

  [[nodiscard]] std::size_t total() const { return total_; }
  [[nodiscard]] int32_t count(int axis) const { return count_[axis]; }
  [[nodiscard]] std::size_t stride(int axis) const { return stride_[axis]; }
  [[nodiscard]] std::size_t index(const Coordinates<D>& brick) const {
    std::size_t at = 0;
    for (int a = 0; a < D; ++a) at += static_cast<std::size_t>(brick[a]) * stride_[a];
    return at;
  }
  static constexpr std::size_t kNowhere = SIZE_MAX;
  using Around = std::array<std::size_t, power(3, D)>;
  /// The places of the 3^D bricks around one, itself in the middle, the first axis fastest;
  /// kNowhere beyond the table.
  [[gnu::noinline]] Around around(const Coordinates<D>& brick) const {
    Around brickIndices;
    alongAxis<D - 1>(brick, index(brick), brickIndices.data());
    return brickIndices;
  }
  /// Of the brick that a vertex lies in.
  [[nodiscard]] std::size_t brickIndexOf(const Coordinates<D>& v) const {
    std::size_t brickIndex = 0;
    for (int a = 0; a < D; ++a) brickIndex += static_cast<std::size_t>(v[a] >> 3) * stride_[a];
    return brickIndex;
  }
  [[nodiscard]] Coordinates<D> brick(std::size_t brickIndex) const {
    Coordinates<D> at{};
    for (int a = D - 1; a >= 0; --a) {
      at[a] = static_cast<int32_t>(brickIndex / stride_[a]);
      brickIndex %= stride_[a];
    }
    return at;
  }
  /// To the next place.
  void advance(Coordinates<D>& brick) const {
    for (int a = 0; a < D && ++brick[a] == count_[a]; ++a) brick[a] = 0;
  }

 private:
  template <int Axis>
  void alongAxis(const Coordinates<D>& brick, std::size_t brickIndex,
                 std::size_t* brickIndices) const {
    brickIndex -= stride_[Axis];
    for (int32_t at = brick[Axis] - 1; at <= brick[Axis] + 1;
         ++at, brickIndices += power(3, Axis), brickIndex += stride_[Axis]) {
      if (static_cast<uint32_t>(at) >= static_cast<uint32_t>(count_[Axis]))
        std::fill_n(brickIndices, power(3, Axis), kNowhere);
      else if constexpr (Axis == 0)
        *brickIndices = brickIndex;
      else
        alongAxis<Axis - 1>(brick, brickIndex, brickIndices);
    }
  }

  std::array<int32_t, D> count_{};
  std::array<std::size_t, D> stride_{};
  std::size_t total_ = 0;
};

/// A sign for every vertex of a lattice. Bricks 0 and 1 are shared by all places that are wholly
/// negative or positive.
template <int D>
class Signs {
 public:
  static constexpr uint32_t kNegative = 0, kPositive = 1;

  Signs() = default;
  explicit Signs(const Lattice<D>& lattice)
      : lattice_(lattice), table_(lattice), at_(table_.total(), kNegative), bricks_(2) {
    bricks_[kNegative].rows.fill(0x00);
    bricks_[kPositive].rows.fill(0xFF);
  }

  [[nodiscard]] const Lattice<D>& lattice() const { return lattice_; }
  [[nodiscard]] const BrickTable<D>& table() const { return table_; }
  [[nodiscard]] uint32_t index(std::size_t brickIndex) const { return at_[brickIndex]; }
  [[nodiscard]] const Brick<D>& brick(uint32_t index) const { return bricks_[index]; }
  [[nodiscard]] const Brick<D>& brickAt(std::size_t brickIndex) const {
    return bricks_[at_[brickIndex]];
  }
  [[nodiscard]] uint32_t brickCount() const { return static_cast<uint32_t>(bricks_.size()); }
  /// Bytes in use, while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    return at_.capacity() * sizeof(uint32_t) + memoryToGrow(bricks_);
  }
  /// Bytes that it takes at most to put so many bricks one after the other.
  [[nodiscard]] static uint64_t memoryToFill(uint64_t brickIndices, uint64_t bricks) {
    return brickIndices * sizeof(uint32_t) +
           3 * (std::min(bricks, brickIndices) + 2) * sizeof(Brick<D>);
  }

  void fill(uint32_t uniform) { std::fill(at_.begin(), at_.end(), uniform); }
  void setUniform(std::size_t brickIndex, uint32_t uniform) { at_[brickIndex] = uniform; }

  /// The brick at a place, to be written: a uniform one gets rows of its own first.
  Brick<D>& writable(std::size_t brickIndex) {
    uint32_t& index = at_[brickIndex];
    if (index <= kPositive) {
      bricks_.push_back(bricks_[index]);
      index = brickCount() - 1;
    }
    return bricks_[index];
  }
  /// Puts a brick at a place that has none of its own yet; one of a single sign is shared.
  void put(std::size_t brickIndex, const Brick<D>& brick) {
    if (brick == bricks_[kNegative]) {
      at_[brickIndex] = kNegative;
    } else if (brick == bricks_[kPositive]) {
      at_[brickIndex] = kPositive;
    } else {
      at_[brickIndex] = brickCount();
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
  [[nodiscard]] static std::size_t rowOf(const Coordinates<D>& v) {
    std::size_t row = 0;
    for (int a = D - 1; a >= 1; --a) row = row * 8 + static_cast<std::size_t>(v[a] & 7);
    return row;
  }

  Lattice<D> lattice_;
  BrickTable<D> table_;
  std::vector<uint32_t> at_;
  std::vector<Brick<D>> bricks_;
};

/// Calls visit(v) for each positive vertex, as of a set; visit may turn v itself.
template <int D, class Visit>
void forEachMember(const Signs<D>& set, Visit visit) {
  for (std::size_t brickIndex = 0; brickIndex < set.table().total(); ++brickIndex) {
    if (set.index(brickIndex) == Signs<D>::kNegative) continue;
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
