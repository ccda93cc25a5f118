// A scalar from its neighbours on both sides, where a coarser pass has told them.
#pragma once

#include "reciprocal.h"
#include "scalar_window.h"

namespace isostar {

template <int D>
struct Interpolation {
  int64_t magnitude = 0;  // half quanta
  int confidence = 0;     // 0: no two opposite neighbours are known … 3

  /// Pairs of opposite neighbours count by how near they are.
  static Interpolation of(const ScalarWindow<D>& scalars, std::size_t r, int x, bool positive) {
    const int32_t* here = &scalars.value[ScalarWindow<D>::index(r, x)];
    int64_t sum = 0;
    int32_t weight = 0;
    for (const Pair& p : kPairs) {
      const int32_t a = here[p.offset], b = here[-p.offset];
      const int32_t known = a != Scalars<D>::kUnknown && b != Scalars<D>::kUnknown ? -1 : 0;
      sum += (int64_t{a} + b) * (p.weight & known);
      weight += p.weight & known;
    }
    if (weight == 0) return {};
    const int64_t mean = (positive ? sum : -sum) * reciprocal(2 * weight) >> 16;
    return {mean < 0 ? 0 : mean, weight < 4 ? 1 : weight < 8 ? 2 : 3};
  }

 private:
  struct Pair {
    int offset = 0;
    int32_t weight = 0;
  };
  static constexpr std::array<Pair, (power(3, D) - 1) / 2> kPairs = [] {
    std::array<Pair, (power(3, D) - 1) / 2> all{};
    std::array<int, D> d{};
    d.fill(-1);
    for (Pair& pair : all) {
      int squares = 0;
      for (int a = 0; a < D; ++a) {
        squares += d[a] * d[a];
        pair.offset += d[a] * ScalarWindow<D>::stride(a);
      }
      pair.weight = squares == 1 ? 4 : squares == 2 ? 2 : 1;
      for (int a = 0; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
    return all;
  }();
};

}  // namespace isostar
