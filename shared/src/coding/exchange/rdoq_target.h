// RDOQ of magnitudes (§5.3): the encoder codes a value other than the actual one where that brings
// crossings nearer or costs fewer bits.
#pragma once

#include "coding/exchange/crossing_distortion.h"
#include "entropy/models.h"

namespace isostar {

/// Wraps a coder for one decision: it codes the opposite of the actual decision where the
/// distortion cost() of that is less than the information saved, both in 1/256 of a natural unit.
template <class Coder, class Cost>
class BiasedCoder {
 public:
  BiasedCoder(Coder& coder, Cost cost) : coder_(coder), cost_(cost) {}

  bool bit(bool actual, uint32_t probability) {
    const int saved = Logistic::stretch(actual ? kProbabilityOne - probability : probability);
    return coder_.bit(saved > 0 && saved > cost_() ? !actual : actual, probability);
  }

 private:
  Coder& coder_;
  Cost cost_;
};

/// The magnitude that refinement moves towards: the actual one, unless another has less cost.
/// Middles and half widths are those that Scalars store.
template <int D>
class RdoqTarget {
 public:
  RdoqTarget(uint32_t actual, const CrossingDistortion<D>& distortion)
      : magnitude_(actual), distortion_(distortion) {}

  [[nodiscard]] uint32_t magnitude() const { return magnitude_; }
  [[nodiscard]] bool upper(uint32_t middle) const { return 2 * uint64_t{magnitude_} >= middle; }

  /// Chooses a neighbouring interval of the one that holds the actual magnitude, if its distortion
  /// is less. `settled(magnitude)`: the middle of the last interval if refinement follows that
  /// magnitude. `middle`, `half`: the middle and half the width of the first interval.
  template <class Settled>
  void choose(uint32_t middle, uint32_t half, Settled settled) {
    if (distortion_.empty()) return;
    const uint32_t own = settled(magnitude_), ownHalf = own & -own;
    least_ = distortion_.of(own);
    if (own - ownHalf > middle - half) consider(own - ownHalf, (own - ownHalf) / 2 - 1, settled);
    if (own + ownHalf < middle + half) consider(own + ownHalf, (own + ownHalf) / 2, settled);
  }

  /// Calls code(coder), which codes whether the magnitude lies in the upper half of the interval
  /// and returns the coded decision. The target then follows that decision.
  template <class Coder, class Settled, class Code>
  bool codeUpper(Coder& coder, uint32_t middle, Settled settled, Code code) {
    if (distortion_.empty()) return code(coder);
    const bool actual = upper(middle);
    const uint32_t nearest = actual ? middle / 2 - 1 : middle / 2;
    double error = -1;
    BiasedCoder biased(coder, [&] {
      error = distortion_.of(settled(nearest));
      return distortion_.mayEndAt(middle) ? (error - least_) * kInformationPerSquare : kNever;
    });
    const bool coded = code(biased);
    if (coded != actual) magnitude_ = nearest, least_ = error;
    return coded;
  }

 private:
  /// The information that a squared error is worth, in 1/256 of a natural unit; the unit of
  /// errors is what a pass allows. Measured as the best value.
  static constexpr double kInformationPerSquare = 256 / 0.05, kNever = 1e9;

  template <class Settled>
  void consider(uint32_t end, uint32_t magnitude, Settled settled) {
    const double error = distortion_.of(settled(magnitude));
    if (error < least_ && distortion_.mayEndAt(end)) magnitude_ = magnitude, least_ = error;
  }

  uint32_t magnitude_;
  CrossingDistortion<D> distortion_;
  double least_ = 0;  // the distortion if refinement follows magnitude_
};

/// The decoder's side: it has no target and compiles to nothing.
struct NoRdoqTarget {
  [[nodiscard]] static bool upper(uint32_t) { return false; }
  template <class Settled>
  static void choose(uint32_t, uint32_t, Settled) {}
  template <class Coder, class Settled, class Code>
  static bool codeUpper(Coder& coder, uint32_t, Settled, Code code) {
    return code(coder);
  }
};

}  // namespace isostar
