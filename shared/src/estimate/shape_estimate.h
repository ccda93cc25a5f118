// Where the signs alone put the surface: a weighted sum of the signs around each vertex of a brick,
// and its gradient.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "grid/window.h"
#include "util/cold_path.h"

namespace isostar {

/// How far around a vertex signs count. A wide filter locates smooth surfaces best, a narrow one
/// noise and coarse levels.
enum class SmoothingFilter : uint8_t { Narrow, Middle, Wide };

/// Weights over the 5^D vertices around a vertex, close to a Gaussian's. They are separable: for
/// the wide filter, the product of 1, 5, 8, 5, 1 on each axis. So sums are made axis by axis, for a
/// row of eight vertices at once. Sums are scaled to be about as large in every dimension as in 3D.
template <int D>
class ShapeEstimate {
 public:
  explicit ShapeEstimate(SmoothingFilter filter)
      : own_(weights(filter).own),
        beside_(weights(filter).beside),
        far_(weights(filter).far),
        scale_(weights(filter).scale) {
    tabulate();
  }

  /// Computes sums and slopes for all vertices of the window's brick.
  void load(const Window<D>& window) {
    for (std::size_t r = 0; r < kRows; ++r) {
      alongRow(smooth_, window.rows[r], fields_[0][r]);
      alongRow(slope_, window.rows[r], fields_[1][r]);
    }
    forEachAxis<D>([&](auto axis) {
      if constexpr (axis > 0) {
        constexpr std::size_t kInner = power(kBrickSide, axis - 1),
                              kOuter = power(Window<D>::kSide, D - 1 - axis);
        if constexpr (axis == 3)
          forRows(axis + 1, kOuter * Window<D>::kSide * kInner, [](Row row) { return row >> 4; });
        slope<kOuter, kInner>(fields_[0].data(), fields_[axis + 1].data());
        for (std::size_t f = 0; f <= axis; ++f) smooth<kOuter, kInner>(fields_[f].data());
      }
    });
    if constexpr (D < 3)
      forRows(D + 1, power(kBrickSide, D - 1), [](Row row) { return row * kWeightSum; });
  }

  /// The sum of weight · sign (±1) around vertex x of row r. Its absolute value grows with the
  /// distance to the surface.
  [[nodiscard]] int32_t sum(std::size_t r, int x) const { return scaled(fields_[0][r][x]); }
  /// The sum of weight · sign · offset along an axis: positive where the field grows.
  [[nodiscard]] int32_t slope(int axis, std::size_t r, int x) const {
    return scaled(fields_[static_cast<std::size_t>(axis) + 1][r][x]);
  }

 private:
  using Row [[gnu::vector_size(16)]] = int16_t;
  using Half = std::array<int16_t, 4>;
  static constexpr std::size_t kRows = Window<D>::kRows;
  static constexpr int16_t kWeightSum = 20;
  /// On one axis: the weights of a vertex itself, of those beside it and of those two steps away.
  /// Their sum over the axis is kWeightSum for every filter. `scale`: by how many 256ths sums are
  /// multiplied, so that a plane has about the same slope for every filter.
  struct Weights {
    int16_t own, beside, far, scale;
  };
  static constexpr Weights weights(SmoothingFilter filter) {
    return filter == SmoothingFilter::Narrow   ? Weights{12, 4, 0, 171}
           : filter == SmoothingFilter::Middle ? Weights{10, 5, 0, 205}
                                               : Weights{8, 5, 1, 256};
  }

  [[nodiscard]] int32_t scaled(int32_t sum) const { return sum * scale_ >> 8; }

  template <class Change>
  void forRows(std::size_t fields, std::size_t rows, Change change) {
    for (std::size_t f = 0; f < fields; ++f) {
      for (std::size_t r = 0; r < rows; ++r) fields_[f][r] = change(fields_[f][r]);
    }
  }

  /// Fills the tables of sums and slopes along a row, for four vertices by the eight signs around
  /// them.
  [[gnu::noinline]] ISOSTAR_COLD void tabulate() {
    const std::array<int, 5> weights{far_, beside_, own_, beside_, far_};
    for (unsigned signs = 0; signs < 256; ++signs) {
      for (unsigned x = 0; x < 4; ++x) {
        int sum = 0, slope = 0;
        for (int d = 0; d < 5; ++d) {
          const int weight = (signs >> (x + static_cast<unsigned>(d)) & 1) != 0
                                 ? weights[static_cast<std::size_t>(d)]
                                 : -weights[static_cast<std::size_t>(d)];
          sum += weight;
          slope += weight * (d - 2);
        }
        smooth_[signs][x] = static_cast<int16_t>(sum);
        slope_[signs][x] = static_cast<int16_t>(slope);
      }
    }
  }

  /// Writes two halves straight to memory, where they are read as a whole much later: reading them
  /// at once would stall the processor.
  static void alongRow(const std::array<Half, 256>& table, unsigned signs, Row& row) {
    auto* halves = reinterpret_cast<std::byte*>(&row);
    std::memcpy(halves, &table[signs & 255], sizeof(Half));
    std::memcpy(halves + sizeof(Half), &table[signs >> 4 & 255], sizeof(Half));
  }

  /// From the twelve planes of a window on an axis to the eight of a brick. Works in place, because
  /// nothing is read again after it has been overwritten.
  template <std::size_t Outer, std::size_t Inner>
  void smooth(Row* rows) const {
    forPlanes<Outer, Inner>(rows, rows, [own = own_, beside = beside_, far = far_](const Row* at) {
      return far * (at[0] + at[4 * Inner]) + beside * (at[Inner] + at[3 * Inner]) +
             own * at[2 * Inner];
    });
  }
  template <std::size_t Outer, std::size_t Inner>
  void slope(const Row* rows, Row* out) const {
    forPlanes<Outer, Inner>(
        rows, out, [beside = beside_, far = static_cast<int16_t>(2 * far_)](const Row* at) {
          return far * (at[4 * Inner] - at[0]) + beside * (at[3 * Inner] - at[Inner]);
        });
  }
  template <std::size_t Outer, std::size_t Inner, class Filter>
  static void forPlanes(const Row* rows, Row* out, Filter filter) {
    for (std::size_t o = 0; o < Outer; ++o, rows += (Window<D>::kSide - kBrickSide) * Inner) {
      for (std::size_t i = 0; i < kBrickSide * Inner; ++i) *out++ = filter(rows++);
    }
  }

  const int16_t own_, beside_, far_, scale_;
  std::array<Half, 256> smooth_, slope_;
  std::array<std::array<Row, kRows>, D + 1> fields_;  // the sum, then the slope on each axis
};

}  // namespace isostar
