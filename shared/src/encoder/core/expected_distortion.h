// The distortion of the crossings around a vertex, as a function of the value that is coded for its
// scalar.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "coding/exchange/crossing_distortion.h"
#include "encoder/core/field.h"
#include "scalars/scalars.h"

namespace isostar {

/// Far ends that are already coded count as coded, others as they will probably be coded.
template <int D>
class ExpectedDistortion {
 public:
  /// Field and header must outlive it.
  ExpectedDistortion(const GridField<D>& field, const Header& header)
      : field_(field), header_(header) {}

  /// The distortion around vertex x in row r of a brick. `codedAt(axis, ahead)`: what Scalars store
  /// for the next vertex along an axis, or for the previous one. `allowed`: what the pass allows,
  /// by edge as in FarEnds.
  template <class CodedAt, class Allowed>
  [[nodiscard]] CrossingDistortion<D> around(std::size_t brickIndex, std::size_t r, int x,
                                             CodedAt codedAt, const Allowed& allowed) const {
    const double toHalfSteps = 2 / header_.quantizationStep,
                 own = field_.scalar(brickIndex, r, x) * toHalfSteps, size = std::abs(own);
    const double positive = 2 * header_.positiveOffset - 1,
                 negative = 2 * header_.negativeOffset - 1, offset = own > 0 ? negative : positive;
    const auto neighbours = field_.around(brickIndex, r, x);
    // Squared components of the normal, in units of what the pass allows.
    std::array<double, D> slopes;
    double all = std::numeric_limits<double>::min();
    for (std::size_t a = 0; a < D; ++a) {
      const double slope =
          (neighbours[2 * a + 1] - neighbours[2 * a]) * allowed[std::size_t{1} << a];
      all += slopes[a] = slope * slope;
    }
    CrossingDistortion<D> distortion(own > 0 ? positive : negative);
    for (std::size_t i = 0; i < 2 * D; ++i) {
      const double actual = std::abs(neighbours[i]) * toHalfSteps,
                   part = allowed[std::size_t{1} << i / 2] / 65536.0;
      const int32_t coded = codedAt(static_cast<int>(i / 2), i % 2 != 0);
      if (coded == Scalars<D>::kUnknown || (neighbours[i] > 0) == (own > 0) || !(size + actual > 0))
        continue;
      const FarEnd far = i % 2 == 0 ? FarEnd{std::abs(coded) + offset, 1}
                                    : expected(std::abs(coded), actual, offset, size, part);
      distortion.add(
          {size / (size + actual), actual, far.size, 1 / part, slopes[i / 2] / all, far.leaves});
    }
    return distortion;
  }

 private:
  struct FarEnd {
    double size;    // half quantization steps
    double leaves;  // the error left to this vertex, in units of what the pass allows
  };
  /// What will be coded for a far end that comes later, if its refinement depended on this edge
  /// only. RDOQ may then change that value as well.
  [[nodiscard]] static FarEnd expected(int32_t middle, double actual, double offset, double size,
                                       double part) {
    constexpr double kRoom = 0.8, kTrust = 0.7;  // measured as the best values
    double at = middle, width = 2.0 * (middle & -middle);
    const auto moves = [&] {
      return width > 2 && size * width > part * (size + at + offset) * (size + at + offset);
    };
    if (!moves()) return {at + offset, kRoom};
    for (; moves(); width /= 2) at += actual - offset >= at ? width / 4 : -width / 4;
    return {actual + kTrust * (at + offset - actual), kRoom};
  }

  const GridField<D>& field_;
  const Header& header_;
};

}  // namespace isostar
