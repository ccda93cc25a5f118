// What the neighbours with known scalars and the signs around tell of a vertex's scalar.
#pragma once

#include <utility>

#include "reciprocal.h"
#include "scalar_window.h"
#include "shape_estimate.h"

namespace isostar {

/// Half quanta by which the field changes in a grid step, and how far scalars are scaled down to be summed up.
class Steps {
 public:
  /// From a gradient as Scalars keep it.
  explicit Steps(int quarterOctaves = 0) : shift_(std::max(0, (quarterOctaves >> 2) - 13)) {
    constexpr std::array<uint32_t, 4> kRoots{256, 304, 362, 431};  // 256 · 2^(i/4)
    const uint64_t steps = (uint64_t{kRoots[static_cast<std::size_t>(quarterOctaves & 3)]} << (quarterOctaves >> 2)) >> 7;
    steps_ = static_cast<int64_t>(steps >> shift_);
  }
  [[nodiscard]] int shift() const { return shift_; }
  /// An eighth of a step, but not nothing.
  [[nodiscard]] int64_t eighth() const { return std::max<int64_t>(1, (steps_ << shift_) / 8); }
  /// As many steps as a ShapeEstimate says, scaled down. A plane's slope is 2^20 / 181.
  [[nodiscard]] int64_t times(int32_t estimate) const { return (estimate * steps_ * 181) >> 20; }

 private:
  int shift_;
  int64_t steps_;
};

template <int D>
struct Prediction {
  int64_t magnitude = 0;  // half quanta
  int confidence = 0;     // 0: from the signs alone … 3: many neighbours are known
  int shape = 0;          // 0 … 63: the weighed sum of signs, seen from the vertex's own side

  /// Known neighbours are extrapolated along the slope that the signs show. `steps`: half quanta by which the field
  /// changes in a grid step.
  static Prediction of(const ShapeEstimate<D>& shapes, const ScalarWindow<D>& scalars, bool positive, std::size_t r, int x, Steps steps) {
    const int32_t own = positive ? shapes.sum(r, x) : -shapes.sum(r, x);
    Prediction result;
    result.shape = std::clamp((own + 1024) >> 7, 0, 63);
    const Around around(&scalars.value[ScalarWindow<D>::index(r, x)], steps.shift());
    if (around.weight == 0) {
      result.magnitude = own <= 0 ? 0 : steps.times(own) << steps.shift();
      return result;
    }
    int32_t tilt = 0;
    for (int a = 0; a < D; ++a) tilt += shapes.slope(a, r, x) * around.moment[a];
    const int64_t sum = around.sum - steps.times(tilt);
    const int64_t mean = (positive ? sum : -sum) * reciprocal(around.weight) >> 16;
    result.magnitude = mean < 0 ? 0 : mean << steps.shift();
    result.confidence = around.weight < 5 ? 1 : around.weight < 12 ? 2 : 3;
    return result;
  }

 private:
  /// The 3^D - 1 vertices around one that is unknown: weights are 4, 2, 1 by distance.
  struct Around {
    int32_t sum = 0;                   // weight · value of the known ones
    int32_t weight = 0;                // of the known ones
    std::array<int32_t, D> moment{};   // weight · offset

    Around(const int32_t* here, int shift) {
      std::array<Lanes, D> values{}, knowns{};  // of rows by distance, so that weights are shifts
      std::array<Lanes, D> tilted{};            // by axis, weighed
      auto add = [&]<std::size_t I>(std::integral_constant<std::size_t, I>) {
        constexpr Row n = kRows[I];
        const typename ScalarWindow<D>::Three three(here + n.offset - 1, shift);
        values[n.distance] += three.value;
        knowns[n.distance] += three.known;
        for (int a = 1; a < D; ++a) {
          if (n.d[a] != 0) tilted[a] += n.d[a] * (three.known << (D - 1 - n.distance));
        }
      };
      // Unrolled, so that offsets and weights are constants.
      [&]<std::size_t... I>(std::index_sequence<I...>) { (add(std::integral_constant<std::size_t, I>{}), ...); }
      (std::make_index_sequence<kRows.size()>{});
      Lanes value{}, known{};
      for (int n = 0; n < D; ++n) {
        value = value * 2 + values[n];
        known = known * 2 + knowns[n];
      }
      sum = weighed(value);
      weight = -weighed(known);
      moment[0] = known[0] - known[2];
      for (int a = 1; a < D; ++a) moment[a] = -weighed(tilted[a]);
    }
  };
  struct Row {
    int offset = 0, distance = 0;
    std::array<int, D> d{};
  };
  static constexpr std::array<Row, power(3, D - 1)> kRows = [] {
    std::array<Row, power(3, D - 1)> all{};
    std::array<int, D> d{};
    for (int a = 1; a < D; ++a) d[a] = -1;
    for (Row& row : all) {
      row.d = d;
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
