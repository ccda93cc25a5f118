// Where the signs alone put the surface: a weighed sum of the signs around a vertex, and its gradient.
#pragma once

#include <array>
#include <cstdint>

#include "window.h"

namespace isostar {

/// Gaussian weights over the 5^D vertices around, one table look-up a row of five.
template <int D>
class ShapeEstimate {
 public:
  struct Value {
    int32_t sum = 0;            // of weight · sign: grows with the distance to the surface
    std::array<int32_t, D> slope{};  // of weight · sign · offset: points to larger values
  };

  /// At bit `at` (x + kHalo) of a window's row.
  [[nodiscard]] static Value of(const Window<D>& window, int row, int at) {
    Value value;
    const int shift = at - 2;
    std::array<int, D> d{};
    d.fill(-2);
    int here = row;
    for (int a = 1; a < D; ++a) here -= 2 * Window<D>::rowStride(a);
    for (std::size_t n = 0; n < power(5, D - 1); ++n) {
      const uint32_t five = static_cast<uint32_t>(window.rows[here]) >> shift & 31;
      const Entry& entry = kTable[n][five];
      value.sum += entry.sum;
      value.slope[0] += entry.slope;
      for (int a = 1; a < D; ++a) value.slope[a] += entry.sum * d[a];
      ++here;
      if (D > 1) {
        ++d[1];
        for (int a = 1; a < D - 1 && d[a] == 3; ++a) {
          d[a] = -2;
          here += Window<D>::rowStride(a + 1) - 5 * Window<D>::rowStride(a);
          ++d[a + 1];
        }
      }
    }
    return value;
  }

  /// The slope's length where the surface is plane.
  static constexpr int32_t kPlaneSlope = 2900;
  /// The sum a step away from a plane surface.
  static constexpr int32_t kPlaneSum = 2900;

 private:
  struct Entry {
    int16_t sum = 0, slope = 0;
  };
  /// 256 e^(-d²/2) by squared distance.
  static constexpr std::array<int, 17> kWeight{256, 155, 94, 57, 35, 21, 13, 8, 5, 3, 2, 1, 1, 0, 0, 0, 0};

  static constexpr std::array<std::array<Entry, 32>, power(5, D - 1)> kTable = [] {
    std::array<std::array<Entry, 32>, power(5, D - 1)> table{};
    std::array<int, D> d{};
    d.fill(-2);
    for (std::size_t n = 0; n < power(5, D - 1); ++n) {
      for (unsigned bits = 0; bits < 32; ++bits) {
        for (int x = -2; x <= 2; ++x) {
          int squares = x * x;
          for (int a = 1; a < D; ++a) squares += d[a] * d[a];
          const int weight = kWeight[static_cast<std::size_t>(squares > 16 ? 16 : squares)] * ((bits >> (x + 2) & 1) != 0 ? 1 : -1);
          table[n][bits].sum = static_cast<int16_t>(table[n][bits].sum + weight);
          table[n][bits].slope = static_cast<int16_t>(table[n][bits].slope + weight * x);
        }
      }
      for (int a = 1; a < D && ++d[a] == 3; ++a) d[a] = -2;
    }
    return table;
  }();
};

}  // namespace isostar
