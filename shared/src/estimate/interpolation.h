// A scalar interpolated between its neighbours on both sides, where a coarser pass has coded them.
#pragma once

#include "scalars/scalar_window.h"
#include "util/reciprocal.h"

namespace isostar {

/// A prediction from pairs of opposite neighbours.
template <int D>
struct Interpolation {
  int64_t magnitude = 0;  // in half quantization steps
  int confidence = 0;     // pairs of opposite neighbours that are known, at most 3

  /// The mean of the pairs of opposite neighbours along the axes of vertex x in row r. `positive`:
  /// the vertex's sign.
  static Interpolation of(const ScalarWindow<D>& scalars, std::size_t r, int x, bool positive) {
    const int32_t* here = &scalars.value[ScalarWindow<D>::index(r, x)];
    int64_t sum = 0;
    int pairs = 0;
    forEachAxis<D>([&](auto a) {
      const int32_t before = here[-ScalarWindow<D>::stride(a)],
                    after = here[ScalarWindow<D>::stride(a)];
      // A mask instead of an unpredictable branch.
      const int32_t known =
          before == Scalars<D>::kUnknown || after == Scalars<D>::kUnknown ? 0 : -1;
      sum += (int64_t{before} + after) & known;
      pairs -= known;
    });
    const int64_t mean = (positive ? sum : -sum) * reciprocal(2 * pairs) >> 16;
    return {std::max<int64_t>(0, mean), std::min(pairs, 3)};
  }
};

}  // namespace isostar
