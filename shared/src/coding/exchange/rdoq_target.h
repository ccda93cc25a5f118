// What the encoder tells of a magnitude instead of the truth: what brings crossings nearer, or
// costs less (§5.3).
#pragma once

#include "coding/exchange/crossing_distortion.h"
#include "entropy/models.h"

namespace isostar {

/// A coder that is told the truth of one decision, and tells the other answer where cost() is less
/// than what that saves, in 1/256 of a natural unit of information.
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

/// The magnitude that halving an interval aims at: the truth where there are no errors to go by.
template <int D>
class RdoqTarget {
 public:
  RdoqTarget(uint32_t actual, const CrossingDistortion<D>& errors)
      : magnitude_(actual), errors_(errors) {}

  [[nodiscard]] uint32_t magnitude() const { return magnitude_; }
  [[nodiscard]] bool upper(uint32_t middle) const { return 2 * uint64_t{magnitude_} >= middle; }

  /// Takes one of the intervals beside the truth's where that errs less. settled(magnitude): the
  /// middle of the interval that halving ends with, all as Scalars keep them; `middle` and `half`
  /// (of its width): of the one to begin with.
  template <class Settled>
  void choose(uint32_t middle, uint32_t half, Settled settled) {
    if (errors_.empty()) return;
    const uint32_t own = settled(magnitude_), ownHalf = own & -own;
    least_ = errors_.of(own);
    if (own - ownHalf > middle - half) consider(own - ownHalf, (own - ownHalf) / 2 - 1, settled);
    if (own + ownHalf < middle + half) consider(own + ownHalf, (own + ownHalf) / 2, settled);
  }

  /// Calls tell(coder), which tells whether the magnitude lies above an interval's middle and
  /// returns what has been told: the aim lies there from now on.
  template <class Coder, class Settled, class Code>
  bool codeUpper(Coder& coder, uint32_t middle, Settled settled, Code code) {
    if (errors_.empty()) return code(coder);
    const bool actual = upper(middle);
    const uint32_t nearest = actual ? middle / 2 - 1 : middle / 2;
    double error = -1;
    BiasedCoder biased(coder, [&] {
      error = errors_.of(settled(nearest));
      return errors_.mayEndAt(middle) ? (error - least_) * kPerSquare : kNever;
    });
    const bool coded = code(biased);
    if (coded != actual) magnitude_ = nearest, least_ = error;
    return coded;
  }

 private:
  /// How much information the square of what a pass allows is worth, in 1/256 of a natural unit:
  /// measured to be best.
  static constexpr double kPerSquare = 256 / 0.05, kNever = 1e9;

  template <class Settled>
  void consider(uint32_t end, uint32_t magnitude, Settled settled) {
    const double error = errors_.of(settled(magnitude));
    if (error < least_ && errors_.mayEndAt(end)) magnitude_ = magnitude, least_ = error;
  }

  uint32_t magnitude_;
  CrossingDistortion<D> errors_;
  double least_ = 0;  // error where it ends
};

/// The decoder's: it has none, and compiles into nothing.
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
