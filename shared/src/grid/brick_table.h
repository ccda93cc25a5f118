// Bricks of 8^D vertices, and the table that numbers those of a lattice.
#pragma once

#include <algorithm>
#include <array>
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

/// Bytes that a vector uses while one element is added. A full vector is copied to a larger one,
/// and both exist for a moment.
template <class T>
uint64_t memoryToGrow(const std::vector<T>& v) {
  return uint64_t{v.size() < v.capacity() ? v.capacity() : 3 * v.capacity()} * sizeof(T);
}

/// A vertex, from its brick's coordinates and its number in the brick.
template <int D>
Coordinates<D> vertexOf(const Coordinates<D>& brick, std::size_t number) {
  Coordinates<D> v;
  for (int a = 0; a < D; ++a, number /= kBrickSide)
    v[a] = brick[a] * kBrickSide + static_cast<int32_t>(number % kBrickSide);
  return v;
}

/// The number of a vertex in its brick; the first axis is the fastest.
template <int D>
std::size_t numberOf(const Coordinates<D>& v) {
  std::size_t number = 0;
  for (int a = D - 1; a >= 0; --a)
    number = number * kBrickSide + static_cast<std::size_t>(v[a] & (kBrickSide - 1));
  return number;
}

/// Numbers the bricks of a lattice: brick indices, the first axis being the fastest.
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
    for (std::size_t n = 0; n < offsets_.size(); ++n) {
      for (int a = 0; a < D; ++a)
        offsets_[n] += static_cast<std::size_t>(int64_t{kDirections[n][a]}) * stride_[a];
    }
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
  /// The directions to the 3^D bricks around a brick, in the order of around().
  static constexpr std::array<Coordinates<D>, power(3, D)> kDirections = [] {
    std::array<Coordinates<D>, power(3, D)> directions{};
    for (std::size_t n = 0; n < directions.size(); ++n) {
      std::size_t digits = n;
      for (std::size_t a = 0; a < D; ++a, digits /= 3)
        directions[n][a] = static_cast<int32_t>(digits % 3) - 1;
    }
    return directions;
  }();
  /// The indices of the 3^D bricks around a brick, itself in the middle, the first axis being the
  /// fastest. kNowhere for bricks outside the table.
  [[gnu::noinline]] Around around(const Coordinates<D>& brick) const {
    Around brickIndices;
    const std::size_t own = index(brick);
    bool interior = true;
    for (int a = 0; a < D; ++a) interior = interior && brick[a] > 0 && brick[a] + 1 < count_[a];
    if (!interior) {
      alongAxis<D - 1>(brick, own, brickIndices.data());
      return brickIndices;
    }
    for (std::size_t n = 0; n < brickIndices.size(); ++n) brickIndices[n] = own + offsets_[n];
    return brickIndices;
  }
  /// The index of the brick that holds a vertex.
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
  /// Moves a brick's coordinates to those of the next index.
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
  Around offsets_{};  // of the indices of bricks around one
};

}  // namespace isostar
