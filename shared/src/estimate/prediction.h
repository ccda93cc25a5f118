// What the signs around a vertex, and the scalars next to it along the axes, tell of its own
// scalar.
#pragma once

#include <algorithm>

#include "estimate/shape_estimate.h"
#include "grid/tube.h"
#include "scalars/scalar_window.h"
#include "util/cold_path.h"
#include "util/reciprocal.h"
#include "util/simd.h"

namespace isostar {

/// Half quanta by which the field changes in a grid step.
class Steps {
 public:
  /// From a gradient as Scalars keep it.
  explicit Steps(int log2Quarters = 0) {
    constexpr std::array<int64_t, 4> kRoots{256, 304, 362, 431};  // 256 · 2^(i/4)
    const auto clamped = static_cast<unsigned>(std::clamp(log2Quarters, 0, 4 * 32));
    steps_ = (kRoots[clamped % 4] << clamped / 4) >> 7;
  }
  /// An eighth of a step, but not nothing.
  [[nodiscard]] int64_t eighth() const { return std::max<int64_t>(1, steps_ / 8); }
  /// As many steps as a ShapeEstimate says. A plane's slope is 2^20 / 181.
  [[nodiscard]] int64_t times(int32_t estimate) const { return (estimate * steps_ * 181) >> 20; }

 private:
  int64_t steps_;
};

/// Sizes of scalars in units of 2^shift half quanta, so that 24 bits hold sums of them.
struct SizeUnit {
  static constexpr int kMostSize = 1 << 21;

  int shift;
  Steps steps;  // in these units

  /// From a gradient as Scalars keep it, which has 18 bits at the most.
  explicit SizeUnit(int gradient)
      : shift(std::max(0, gradient / 4 - 17)), steps(gradient - 4 * shift) {}
};

/// The neighbours along the axes, and a guess from them, in SizeUnits. More of them, and pairs of
/// opposite ones, were measured to cost time and not to save bytes.
template <int D>
struct Prediction {
  static constexpr int32_t kLeastEstimate = 256;

  int32_t magnitude = 0;        // the guess
  int32_t own = 0, theirs = 0;  // what the signs and displacements alone tell of this vertex, and
                                // of known neighbours summed up
  int shape = 0;      // 0 … 63: the weighed sum of signs, seen from the vertex's own side
  int crossings = 0;  // neighbours of the other sign
  int32_t other = 0, same = 0;  // |scalars| of the known neighbours of each sign, summed up
  int others = 0, known = 0;    // how many neighbours of the other sign are known, and of both

  /// Of vertex x in row r of the tube's brick, in row `row` of its window. Known neighbours are
  /// extrapolated along the slope that the signs show. `displaced`: by how much the surface lies
  /// off where they put it, as a ShapeEstimate counts.
  ISOSTAR_OFTEN static Prediction of(const ShapeEstimate<D>& shapes, const ScalarWindow<D>& scalars,
                                     const Tube<D>& tube, int row, std::size_t r, int x, bool mine,
                                     const SizeUnit& unit, int32_t displaced) {
    Prediction p;
    const int32_t estimate = shapes.sum(r, x) - displaced, own = mine ? estimate : -estimate;
    p.own = std::max(own, kLeastEstimate);
    p.shape = std::clamp((own + 1024) >> 7, 0, 63);
    p.crossings = mine ? 2 * D - tube.positivesBeside(row, x) : tube.positivesBeside(row, x);
    const int32_t* here = &scalars.value[ScalarWindow<D>::index(r, x)];
    std::array<int32_t, kVectors * 4> values, slopes{};
    values.fill(Scalars<D>::kUnknown);
    forEachAxis<D>([&](auto a) {
      constexpr int kStride = ScalarWindow<D>::stride(a);
      const int32_t slope = shapes.slope(a, r, x);
      values[2 * a] = here[-kStride];
      values[2 * a + 1] = here[kStride];
      slopes[2 * a] = -slope;
      slopes[2 * a + 1] = slope;
    });
    Lanes others{}, all{}, theirs{}, counted{};
    for (std::size_t i = 0; i < kVectors; ++i) {
      const Lanes value = lanes(&values[i * 4]), slope = lanes(&slopes[i * 4]);
      const Lanes known = value != Scalars<D>::kUnknown, negative = value >> 31,
                  crossing = mine ? negative : ~negative;
      const Lanes size =
          smaller(((value ^ negative) - negative) >> unit.shift, Lanes{} + SizeUnit::kMostSize) &
          known;
      others += size & crossing;
      all += size;
      theirs +=
          larger(((slope + estimate) ^ negative) - negative, Lanes{} + kLeastEstimate) & known;
      counted += ((slope << 8) + 16 + (crossing & 1)) & known;
    }
    const Lanes sum = sums(others, all, theirs, counted);
    p.other = sum[0];
    p.same = sum[1] - sum[0];
    p.theirs = sum[2];
    p.others = sum[3] & 15;
    p.known = sum[3] >> 4 & 15;
    const int64_t tilt = unit.steps.times(sum[3] >> 8),
                  along = p.same - p.other - (mine ? tilt : -tilt);
    p.magnitude = static_cast<int32_t>(std::max<int64_t>(
        0, p.known == 0 ? unit.steps.times(own) : along * reciprocal(p.known) >> 16));
    return p;
  }

 private:
  static constexpr std::size_t kVectors = (2 * D + 3) / 4;
  static Lanes lanes(const int32_t* values) {
    return Lanes{values[0], values[1], values[2], values[3]};
  }
};

}  // namespace isostar
