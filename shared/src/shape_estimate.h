// Where the signs alone put the surface: a weighed sum of the signs around a vertex, and its gradient.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "window.h"

namespace isostar {

/// Gaussian weights over the 5^D vertices around, one look-up for each row of five.
template <int D>
class ShapeEstimate {
 public:
  struct Value {
    int32_t sum = 0;            // of weight · sign: grows with the distance to the surface
    std::array<int32_t, D> slope{};  // of weight · sign · offset: points to larger values
  };

  /// At bit `at` (x + kHalo) of a window's row.
  [[nodiscard]] static Value of(const Window<D>& window, int row, int at) {
    const uint16_t* here = &window.rows[row];
    // Sums over five rows of five, by their distance on axis 1; in each number weight · sign in the low half and
    // weight · sign · x in the high half.
    int32_t total = 0, slope1 = 0;
    Value value;
    for (std::size_t n = 0; n < kFives; n += D > 1 ? 5 : 1) {
      int32_t plane = five(here, at, n);
      if constexpr (D > 1) {
        const int32_t a = plane, b = five(here, at, n + 1), c = five(here, at, n + 2), d = five(here, at, n + 3), e = five(here, at, n + 4);
        plane += b + c + d + e;
        slope1 += d - b + 2 * (e - a);
      }
      total += plane;
      for (int axis = 2; axis < D; ++axis) value.slope[axis] += static_cast<int16_t>(plane) * kFive[n].d[axis];
    }
    value.sum = static_cast<int16_t>(total);
    value.slope[0] = (total - value.sum) >> 16;
    if constexpr (D > 1) value.slope[1] = static_cast<int16_t>(slope1);
    return value;
  }

 private:
  static constexpr std::size_t kFives = power(5, D - 1);

  struct Five {
    int16_t row = 0;
    uint16_t squares = 0;  // its squared distance, without x
    std::array<int16_t, D> d{};
  };
  static constexpr std::array<Five, kFives> kFive = [] {
    std::array<Five, kFives> all{};
    std::array<int, D> d{};
    d.fill(-2);
    for (Five& five : all) {
      for (int a = 1; a < D; ++a) {
        five.row = static_cast<int16_t>(five.row + d[a] * Window<D>::rowStride(a));
        five.squares = static_cast<uint16_t>(five.squares + d[a] * d[a]);
        five.d[a] = static_cast<int16_t>(d[a]);
      }
      for (int a = 1; a < D && ++d[a] == 3; ++a) d[a] = -2;
    }
    return all;
  }();

  static int32_t five(const uint16_t* here, int at, std::size_t n) {
    return kTable[kFive[n].squares][static_cast<unsigned>(here[kFive[n].row]) >> (at - 2) & 31];
  }

  /// 256 e^(-d²/2) by squared distance.
  static constexpr std::array<int, 14> kWeight{256, 155, 94, 57, 35, 21, 13, 8, 5, 3, 2, 1, 1, 0};

  /// By squared distance of the row and its five signs.
  static constexpr std::array<std::array<int32_t, 32>, 4 * (D - 1) + 1> kTable = [] {
    std::array<std::array<int32_t, 32>, 4 * (D - 1) + 1> table{};
    for (int squares = 0; squares <= 4 * (D - 1); ++squares) {
      for (unsigned bits = 0; bits < 32; ++bits) {
        int sum = 0, slope = 0;
        for (int x = -2; x <= 2; ++x) {
          const int weight = kWeight[static_cast<std::size_t>(std::min(squares + x * x, 13))];
          sum += (bits >> (x + 2) & 1) != 0 ? weight : -weight;
          slope += (bits >> (x + 2) & 1) != 0 ? weight * x : -weight * x;
        }
        table[static_cast<std::size_t>(squares)][bits] = slope * 65536 + sum;
      }
    }
    return table;
  }();
};

}  // namespace isostar
