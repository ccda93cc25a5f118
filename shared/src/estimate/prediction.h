// A vertex's scalar predicted from the signs around it and from the scalars next to it along the
// axes.
#pragma once

#include <algorithm>

#include "estimate/shape_estimate.h"
#include "grid/tube.h"
#include "scalars/scalar_window.h"
#include "util/cold_path.h"
#include "util/reciprocal.h"
#include "util/simd.h"

namespace isostar {

/// The field's slope: half quantization steps per grid step.
class SlopeUnit {
 public:
  /// From a gradient as Scalars store it: 4 log2 of quantization steps.
  explicit SlopeUnit(int quarterLog2 = 0) {
    constexpr std::array<int64_t, 4> kRoots{256, 304, 362, 431};  // 256 · 2^(i/4)
    const auto clamped = static_cast<unsigned>(std::clamp(quarterLog2, 0, 4 * 32));
    steps_ = (kRoots[clamped % 4] << clamped / 4) >> 7;
  }
  /// By how much the field changes in an eighth of a grid step, at least 1.
  [[nodiscard]] int64_t eighth() const { return std::max<int64_t>(1, steps_ / 8); }
  /// The scalar at the distance that a ShapeEstimate gives. Near a plane a ShapeEstimate grows by
  /// 2^20 / 181 per grid step.
  [[nodiscard]] int64_t times(int32_t estimate) const { return (estimate * steps_ * 181) >> 20; }

 private:
  int64_t steps_;
};

/// The unit of |scalars| in a Prediction: 2^shift half quantization steps, so that sums of them fit
/// 24 bits.
struct SizeUnit {
  static constexpr int kMostSize = 1 << 21;

  int shift;
  SlopeUnit steps;  // in these units

  /// From a gradient as Scalars store it; in the unit, it has at most 18 bits.
  explicit SizeUnit(int gradient)
      : shift(std::max(0, gradient / 4 - 17)), steps(gradient - 4 * shift) {}
};

/// The neighbours along the axes, and a prediction from them, in SizeUnits. Measurements showed
/// that more neighbours, and pairs of opposite ones, cost time and save no bytes.
template <int D>
struct Prediction {
  static constexpr int32_t kLeastEstimate = 256;

  int32_t magnitude = 0;  // the prediction
  /// What the signs and displacements alone say of this vertex, and the sum of what they say of its
  /// known neighbours.
  int32_t own = 0, theirs = 0;
  int shape = 0;                // 0 … 63: the weighted sum of signs, relative to the vertex's own
  int crossings = 0;            // how many neighbours have the other sign
  int32_t other = 0, same = 0;  // sums of |scalar| of the known neighbours of each sign
  int others = 0, known = 0;  // how many neighbours of the other sign, and of both signs, are known

  /// Predicts vertex x in row r of the tube's brick, which is row `row` of its window. Known
  /// neighbours are extrapolated along the slope that the signs show. `mine`: the vertex's sign.
  /// `displaced`: by how much the surface is displaced from where the signs put it, in the unit of
  /// a ShapeEstimate.
  ISOSTAR_HOT static Prediction of(const ShapeEstimate<D>& shapes, const ScalarWindow<D>& scalars,
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
          smaller(negated(value, negative) >> unit.shift, Lanes{} + SizeUnit::kMostSize) & known;
      others += size & crossing;
      all += size;
      theirs += larger(negated(slope + estimate, negative), Lanes{} + kLeastEstimate) & known;
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
  /// The negative of each lane whose mask is -1. Unsigned, because kUnknown has no negative; the
  /// callers mask its lanes.
  static Lanes negated(Lanes values, Lanes mask) {
    using Unsigned [[gnu::vector_size(16)]] = uint32_t;
    const auto bits = reinterpret_cast<Unsigned>(mask);
    return reinterpret_cast<Lanes>((reinterpret_cast<Unsigned>(values) ^ bits) - bits);
  }
};

}  // namespace isostar
