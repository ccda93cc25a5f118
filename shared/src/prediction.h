// What the signs around a vertex, and the scalars next to it along the axes, tell of its own scalar.
#pragma once

#include <algorithm>

#include "reciprocal.h"
#include "scalar_window.h"
#include "shape_estimate.h"
#include "tube.h"

namespace isostar {

/// Half quanta by which the field changes in a grid step.
class Steps {
 public:
  /// From a gradient as Scalars keep it.
  explicit Steps(int quarterOctaves = 0) {
    constexpr std::array<int64_t, 4> kRoots{256, 304, 362, 431};  // 256 · 2^(i/4)
    const auto clamped = static_cast<unsigned>(std::clamp(quarterOctaves, 0, 4 * 32));
    steps_ = (kRoots[clamped % 4] << clamped / 4) >> 7;
  }
  /// An eighth of a step, but not nothing.
  [[nodiscard]] int64_t eighth() const { return std::max<int64_t>(1, steps_ / 8); }
  /// As many steps as a ShapeEstimate says. A plane's slope is 2^20 / 181.
  [[nodiscard]] int64_t times(int32_t estimate) const { return (estimate * steps_ * 181) >> 20; }

 private:
  int64_t steps_;
};

/// The neighbours along the axes, and a guess from them. More of them, and pairs of opposite ones, were measured to cost
/// time and not to save bytes.
template <int D>
struct Prediction {
  static constexpr int32_t kLeastEstimate = 256;

  int64_t magnitude = 0;  // the guess, half quanta
  int64_t own = 0, theirs = 0;  // what the signs and displacements alone tell of this vertex, and of known neighbours summed up
  int confidence = 0;     // 0: from the signs alone … 3: three neighbours or more are known
  int shape = 0;          // 0 … 63: the weighed sum of signs, seen from the vertex's own side
  int crossings = 0;      // neighbours of the other sign
  int64_t other = 0, same = 0;  // |scalars| of the known neighbours of each sign, summed up; half quanta
  int others = 0, sames = 0;    // how many these are

  /// Of vertex x in row r of the tube's brick, in row `row` of its window. Known neighbours are extrapolated along the
  /// slope that the signs show. `displaced`: by how much the surface lies off where they put it, as a ShapeEstimate counts.
  static Prediction of(const ShapeEstimate<D>& shapes, const ScalarWindow<D>& scalars, const Tube<D>& tube, int row, std::size_t r, int x,
                       const Steps& steps, int32_t displaced) {
    Prediction p;
    const bool mine = tube.positive(row, x);
    const int32_t estimate = shapes.sum(r, x) - displaced, own = mine ? estimate : -estimate;
    p.own = std::max(own, kLeastEstimate);
    p.shape = std::clamp((own + 1024) >> 7, 0, 63);
    const int32_t* here = &scalars.value[ScalarWindow<D>::index(r, x)];
    int64_t sum = 0;
    int32_t tilt = 0;
    for (int a = 0; a < D; ++a) {
      for (int side = -1; side <= 1; side += 2) {
        const bool theirs = a == 0 ? tube.positive(row, x + side) : tube.positive(row + side * Window<D>::rowStride(a), x);
        const int32_t value = here[side * ScalarWindow<D>::stride(a)];
        // Masks instead of branches, which nobody could predict.
        const int32_t known = value == Scalars<D>::kUnknown ? 0 : -1, crossing = theirs != mine ? -1 : 0;
        const int32_t size = (value < 0 ? -(value & known) : value) & known;
        p.crossings -= crossing;
        p.other += size & crossing;
        p.others -= known & crossing;
        p.same += size & ~crossing;
        p.sames -= known & ~crossing;
        sum += value & known;
        const int32_t slope = side * shapes.slope(a, r, x), beside = estimate + slope;
        tilt += (known & 1) * slope;
        p.theirs += std::max(value < 0 ? -beside : beside, kLeastEstimate) & known;
      }
    }
    const int count = p.others + p.sames;
    if (count == 0) {
      p.magnitude = own <= 0 ? 0 : steps.times(own);
    } else {
      sum -= steps.times(tilt);
      p.magnitude = std::max<int64_t>(0, (mine ? sum : -sum) * reciprocal(count) >> 16);
      p.confidence = std::min(count, 3);
    }
    return p;
  }
};

}  // namespace isostar
