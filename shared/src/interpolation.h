// A scalar from its neighbours on both sides, where a coarser pass has told them.
#pragma once

#include <utility>

#include "reciprocal.h"
#include "scalar_window.h"

namespace isostar {

template <int D>
struct Interpolation {
  int64_t magnitude = 0;  // half quanta
  int confidence = 0;     // 0: no two opposite neighbours are known … 3

  /// Pairs of opposite neighbours count by how near they are. Scalars are scaled down by a shift to be summed up.
  static Interpolation of(const ScalarWindow<D>& scalars, std::size_t r, int x, bool positive, int shift) {
    const int32_t* here = &scalars.value[ScalarWindow<D>::index(r, x)] - 1;
    std::array<Lanes, D> values{}, knowns{};  // of rows by distance, so that weights are shifts
    auto add = [&]<std::size_t I>(std::integral_constant<std::size_t, I>) {
      constexpr Row n = kRows[I];
      const typename ScalarWindow<D>::Three three(here + n.offset, shift), beyond(here - n.offset, shift);
      const Lanes known = three.known & turned(beyond.known);
      values[n.distance] += (three.value + turned(beyond.value)) & known;
      knowns[n.distance] += known;
    };
    // Unrolled, so that offsets are constants. Of the own row the first is one pair, the last is the same again.
    [&]<std::size_t... I>(std::index_sequence<I...>) { (add(std::integral_constant<std::size_t, I>{}), ...); }
    (std::make_index_sequence<kRows.size()>{});
    values[0] &= Lanes{-1, 0, 0, 0};
    knowns[0] &= Lanes{-1, 0, 0, 0};
    Lanes value{}, known{};
    for (int n = 0; n < D; ++n) {
      value = value * 2 + values[n];
      known = known * 2 + knowns[n];
    }
    const int32_t sum = weighed(value), weight = -weighed(known);
    if (weight == 0) return {};
    const int64_t mean = int64_t{positive ? sum : -sum} * reciprocal(2 * weight) >> 16;
    return {mean < 0 ? 0 : mean << shift, weight < 4 ? 1 : weight < 8 ? 2 : 3};
  }

 private:
  static Lanes turned(Lanes three) { return __builtin_shufflevector(three, three, 2, 1, 0, 3); }

  struct Row {
    int offset = 0, distance = 0;
  };
  /// The own row and half of those around.
  static constexpr std::array<Row, (power(3, D - 1) + 1) / 2> kRows = [] {
    std::array<Row, (power(3, D - 1) + 1) / 2> all{};
    std::array<int, D> d{};
    for (int a = 1; a < D; ++a) d[a] = -1;
    for (Row& row : all) {
      for (int a = 1; a < D; ++a) {
        row.distance += d[a] * d[a];
        row.offset += d[a] * ScalarWindow<D>::stride(a);
      }
      for (int a = 1; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
    return all;
  }();
};

}  // namespace isostar
