// What the neighbours with known scalars and the signs around tell of a vertex's scalar.
#pragma once

#include <utility>

#include "reciprocal.h"
#include "scalar_window.h"
#include "shape_estimate.h"

namespace isostar {

template <int D>
struct Prediction {
  int64_t magnitude = 0;  // half quanta
  int confidence = 0;     // 0: from the signs alone … 3: many neighbours are known
  int shape = 0;          // 0 … 63: the weighed sum of signs, seen from the vertex's own side

  /// Known neighbours are extrapolated along the slope that the signs show. `steps`: half quanta by which the field
  /// changes in a grid step.
  static Prediction of(const Window<D>& signs, const ScalarWindow<D>& scalars, int row, std::size_t r, int x, int64_t steps) {
    const bool positive = (signs.rows[row] >> (x + Window<D>::kHalo) & 1) != 0;
    const auto estimate = ShapeEstimate<D>::of(signs, row, x + Window<D>::kHalo);
    const int32_t own = positive ? estimate.sum : -estimate.sum;
    Prediction result;
    result.shape = own < -512 ? 0 : own >= 3584 ? 63 : (own + 512) >> 6;
    int64_t sum = 0;
    uint64_t packed = 0;
    const int32_t* here = &scalars.value[ScalarWindow<D>::index(r, x)];
    auto add = [&]<std::size_t I>(std::integral_constant<std::size_t, I>) {
      constexpr Neighbour n = kAround[I];
      const int32_t value = here[n.offset];
      const int64_t known = value == Scalars<D>::kUnknown ? 0 : -1;
      sum += (value & known) * n.weight;
      packed += n.packed & static_cast<uint64_t>(known);
    };
    // Unrolled, so that offsets and weights are constants, and without branches, which nobody could predict.
    [&]<std::size_t... I>(std::index_sequence<I...>) { (add(std::integral_constant<std::size_t, I>{}), ...); }
    (std::make_index_sequence<kAround.size()>{});
    const auto weight = static_cast<int32_t>(packed & 0xFF);
    if (weight == 0) {
      result.magnitude = own <= 0 ? 0 : own * steps / ShapeEstimate<D>::kPlaneSum;
      return result;
    }
    int64_t tilt = 0;
    for (int a = 0; a < D; ++a) tilt += int64_t{estimate.slope[a]} * (static_cast<int32_t>(packed >> (8 + 8 * a) & 0xFF) - weight);
    sum -= tilt * steps / ShapeEstimate<D>::kPlaneSlope;
    const int64_t mean = (positive ? sum : -sum) * reciprocal(weight) >> 16;
    result.magnitude = mean < 0 ? 0 : mean;
    result.confidence = weight < 5 ? 1 : weight < 12 ? 2 : 3;
    return result;
  }

 private:
  struct Neighbour {
    int offset = 0;
    int64_t weight = 0;
    uint64_t packed = 0;  // a byte for the weight, then for each axis one for weight · (1 + offset): never negative
  };
  /// The 3^D - 1 vertices around.
  static constexpr std::array<Neighbour, power(3, D) - 1> kAround = [] {
    std::array<Neighbour, power(3, D) - 1> all{};
    std::array<int, D> d{};
    d.fill(-1);
    for (std::size_t i = 0; i < all.size();) {
      int squares = 0;
      for (int a = 0; a < D; ++a) squares += d[a] * d[a];
      if (squares != 0) {
        all[i].weight = squares == 1 ? 4 : squares == 2 ? 2 : 1;
        all[i].packed = static_cast<uint64_t>(all[i].weight);
        for (int a = 0; a < D; ++a) {
          all[i].offset += d[a] * ScalarWindow<D>::stride(a);
          all[i].packed |= static_cast<uint64_t>(all[i].weight * (1 + d[a])) << (8 + 8 * a);
        }
        ++i;
      }
      for (int a = 0; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
    return all;
  }();
};

/// Half quanta a grid step, of a gradient as Scalars keep it.
inline int64_t halfQuanta(int quarterOctaves) {
  constexpr std::array<uint32_t, 4> kRoots{256, 304, 362, 431};  // 256 · 2^(i/4)
  const uint64_t steps = (uint64_t{kRoots[static_cast<std::size_t>(quarterOctaves & 3)]} << (quarterOctaves >> 2)) >> 7;
  return static_cast<int64_t>(steps == 0 ? 1 : steps);
}

}  // namespace isostar
