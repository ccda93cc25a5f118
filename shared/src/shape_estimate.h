// Where the signs alone put the surface: a weighed sum of the signs around each vertex of a brick, and its gradient.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "window.h"

namespace isostar {

/// Weights over the 5^D vertices around, nearly a Gaussian's: the product of 1, 5, 8, 5, 1 on each axis, so that the sums
/// are made axis by axis, for a row of eight vertices at once. In each dimension they are about as large as in three.
template <int D>
class ShapeEstimate {
 public:
  void load(const Window<D>& window) {
    for (std::size_t r = 0; r < kRows; ++r) {
      alongRow(kSmooth, window.rows[r], fields_[0][r]);
      alongRow(kSlope, window.rows[r], fields_[1][r]);
    }
    std::size_t inner = 1, outer = kRows / Window<D>::kSide;
    for (std::size_t axis = 1; axis < D; ++axis, inner *= kBrickSide, outer /= Window<D>::kSide) {
      if constexpr (D > 3) {
        if (axis == 3) forRows(axis + 1, outer * Window<D>::kSide * inner, [](Row row) { return row >> 4; });
      }
      slope(fields_[0].data(), fields_[axis + 1].data(), outer, inner);
      for (std::size_t f = 0; f <= axis; ++f) smooth(fields_[f].data(), outer, inner);
    }
    if constexpr (D < 3) forRows(D + 1, power(kBrickSide, D - 1), [](Row row) { return row * kWeightSum; });
  }

  /// Of weight · sign at vertex x of row r: grows with the distance to the surface.
  [[nodiscard]] int32_t sum(std::size_t r, int x) const { return fields_[0][r][x]; }
  /// Of weight · sign · offset: points to larger values.
  [[nodiscard]] int32_t slope(int axis, std::size_t r, int x) const { return fields_[static_cast<std::size_t>(axis) + 1][r][x]; }

 private:
  using Row [[gnu::vector_size(16)]] = int16_t;
  using Half = std::array<int16_t, 4>;
  static constexpr std::size_t kRows = Window<D>::kRows;
  static constexpr std::array<int, 5> kWeight{1, 5, 8, 5, 1};
  static constexpr int16_t kWeightSum = 20;

  template <class Change>
  void forRows(std::size_t fields, std::size_t rows, Change change) {
    for (std::size_t f = 0; f < fields; ++f) {
      for (std::size_t r = 0; r < rows; ++r) fields_[f][r] = change(fields_[f][r]);
    }
  }

  /// Four vertices from the eight signs around them.
  template <bool IsSlope>
  static constexpr std::array<Half, 256> tabulate() {
    std::array<Half, 256> table{};
    for (unsigned signs = 0; signs < 256; ++signs) {
      for (unsigned x = 0; x < 4; ++x) {
        int sum = 0;
        for (int d = 0; d < 5; ++d) {
          const int weight = kWeight[static_cast<std::size_t>(d)] * (IsSlope ? d - 2 : 1);
          sum += (signs >> (x + static_cast<unsigned>(d)) & 1) != 0 ? weight : -weight;
        }
        table[signs][x] = static_cast<int16_t>(sum);
      }
    }
    return table;
  }
  static constexpr std::array<Half, 256> kSmooth = tabulate<false>(), kSlope = tabulate<true>();

  /// By halves straight to memory, where they are read as a whole much later: sooner the processor would have to wait.
  static void alongRow(const std::array<Half, 256>& table, unsigned signs, Row& row) {
    auto* halves = reinterpret_cast<std::byte*>(&row);
    std::memcpy(halves, &table[signs & 255], sizeof(Half));
    std::memcpy(halves + sizeof(Half), &table[signs >> 4 & 255], sizeof(Half));
  }

  /// From the twelve planes of a window on an axis to the eight of a brick; in place too, as nothing is read again once it is written over.
  static void smooth(Row* rows, std::size_t outer, std::size_t inner) {
    forPlanes(rows, rows, outer, inner, [inner](const Row* at) {
      return at[0] + at[4 * inner] + 5 * (at[inner] + at[3 * inner]) + 8 * at[2 * inner];
    });
  }
  static void slope(const Row* rows, Row* out, std::size_t outer, std::size_t inner) {
    forPlanes(rows, out, outer, inner, [inner](const Row* at) { return 2 * (at[4 * inner] - at[0]) + 5 * (at[3 * inner] - at[inner]); });
  }
  template <class Filter>
  static void forPlanes(const Row* rows, Row* out, std::size_t outer, std::size_t inner, Filter filter) {
    for (std::size_t o = 0; o < outer; ++o, rows += (Window<D>::kSide - kBrickSide) * inner) {
      for (std::size_t i = 0; i < kBrickSide * inner; ++i) *out++ = filter(rows++);
    }
  }

  std::array<std::array<Row, kRows>, D + 1> fields_;  // the sum, then the slope on each axis
};

}  // namespace isostar
