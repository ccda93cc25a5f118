#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "bisection/linear_function.h"
#include "entropy/models.h"

namespace isostar::bench {

/// The scalars of a tube's vertices (§5.3) at one step of quantization, each predicted by the
/// linear function of the leaf from which its own was entered.
class ScalarCoder {
 public:
  /// `step` is in the scalars' unit.
  ScalarCoder(const Hierarchy<3>& hierarchy, double step)
      : hierarchy_(hierarchy),
        step_(step),
        values_(Lattice<3>(hierarchy.box(), 1).vertices(), 0.0f),
        weights_(kDecisions, Mixer<3>::initialWeights()) {}

  /// The vertices of a leaf as GateTraversal visits it: positive(sample) is the sign, truth(sample)
  /// the scalar.
  template <class Coder, class Positive, class Actual>
  void code(Coder& coder, const TaggedSimplex<3>& leaf, const TaggedSimplex<3>* from, int newVertex,
            Positive positive, Actual actual) {
    for (int i = 0; i <= 3; ++i) {
      if (from != nullptr && i != newVertex) continue;
      const auto sample = hierarchy_.position(leaf.vertices[i]);
      float& value = values_[place(sample)];
      if (value != 0) continue;
      ++count_;
      const double side = positive(sample) ? 1 : -1;
      const double guess = side * predicted(leaf, from, sample) / step_;
      const auto finer =
          std::min(static_cast<std::size_t>(hierarchy_.maxDepth() - leaf.depth), kSizes - 1);
      const int size =
          codeSize(coder, static_cast<int>(std::abs(actual(sample)) / step_), guess, finer);
      value = static_cast<float>(side * (size + 0.5) * step_);
    }
  }

  /// 0 where none is known.
  [[nodiscard]] double value(const Coordinates<3>& sample) const { return values_[place(sample)]; }
  /// Of all scalars told.
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  // Decisions: is it what is expected, or more; the difference in unary; then its bits, how many
  // and which.
  enum : std::size_t { kExact, kMore, kUnary, kBits = kUnary + 14, kRest = kBits + 20, kDecisions };
  static constexpr std::size_t kSizes = 8, kGuesses = 12, kErrors = 8, kNear = 16;
  static constexpr int kMost = 1 << 20;  // no scalar has so many steps

  [[nodiscard]] std::size_t place(const Coordinates<3>& v) const {
    const auto& box = hierarchy_.box();
    const auto row = static_cast<std::size_t>(v[2]) * static_cast<std::size_t>(box[1] + 1) +
                     static_cast<std::size_t>(v[1]);
    return row * static_cast<std::size_t>(box[0] + 1) + static_cast<std::size_t>(v[0]);
  }

  /// Along the linear function of the leaf before; of a first leaf, half its size.
  [[nodiscard]] double predicted(const TaggedSimplex<3>& leaf, const TaggedSimplex<3>* from,
                                 const Coordinates<3>& sample) const {
    if (from == nullptr) return 0.5 * (hierarchy_.baseStep() >> (leaf.depth / 3));
    return LinearFunction<3>(hierarchy_, *from,
                             [&](const auto& v) { return value(hierarchy_.position(v)); })
        .at(sample);
  }

  static std::size_t logarithm(double x) {
    return x < 1 ? 0 : 1 + static_cast<std::size_t>(std::ilogb(x));
  }

  /// A vertex's scalar in whole steps. `guess` is negative where the prediction has the other sign;
  /// `finer` is how many levels the leaf is coarser than the finest.
  template <class Coder>
  int codeSize(Coder& coder, int actual, double guess, std::size_t finer) {
    const std::size_t bySize =
                          finer * kGuesses + std::min(logarithm(std::abs(guess)), kGuesses - 1),
                      byErrors = finer * kErrors + std::min(logarithm(lastErrors_), kErrors - 1),
                      near =
                          static_cast<std::size_t>(std::clamp(4 * (guess + 1), 0.0, kNear - 1.0));
    const auto bit = [&](std::size_t decision, bool value) {
      const std::array<BitModel*, 3> contexts{
          &bySize_[decision][bySize], &byErrors_[decision][byErrors], &byGuess_[decision][near]};
      return Mixer<3>::bit<127, 12>(coder, value, contexts, weights_[decision]);
    };
    const int expected = static_cast<int>(std::clamp(guess, 0.0, double{kMost}));
    int size = expected;
    if (!bit(kExact, actual == expected)) {
      const bool more = expected == 0 || bit(kMore, actual > expected);
      const int difference = codeDifference(bit, std::abs(actual - expected));
      size = std::clamp(more ? expected + difference : expected - difference, 0, kMost);
    }
    lastErrors_ = 0.75 * lastErrors_ + std::abs(size - expected);
    return size;
  }

  /// A whole number from 1 on.
  template <class Bit>
  static int codeDifference(const Bit& bit, int actual) {
    int least = 1;
    for (std::size_t decision = kUnary; decision < kBits; ++decision, ++least) {
      if (!bit(decision, actual > least)) return least;
    }
    const int rest = actual - least + 1;
    int bits = 0;
    while (bits < 19 && bit(kBits + static_cast<std::size_t>(bits), rest >> (bits + 1) != 0))
      ++bits;
    int coded = 1;
    for (int i = bits - 1; i >= 0; --i) coded = 2 * coded + bit(kRest, (rest >> i & 1) != 0);
    return least - 1 + coded;
  }

  Hierarchy<3> hierarchy_;
  double step_;
  std::vector<float> values_;  // by sample
  std::size_t count_ = 0;
  double lastErrors_ = 0;  // differences lately, the last ones loudest
  std::array<std::array<BitModel, kSizes * kGuesses>, kDecisions> bySize_;
  std::array<std::array<BitModel, kSizes * kErrors>, kDecisions> byErrors_;
  std::array<std::array<BitModel, kNear>, kDecisions> byGuess_;
  std::vector<Mixer<3>::Weights> weights_;
};

}  // namespace isostar::bench
