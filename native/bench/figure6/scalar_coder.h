#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "bisection/linear_function.h"
#include "entropy/models.h"

namespace isostar::bench {

/// Codes the scalars of a tube's vertices (§5.3) with one quantization step. Each is predicted by
/// the linear function of the leaf from which the traversal entered its leaf.
class ScalarCoder {
 public:
  /// `step` is the quantization step.
  ScalarCoder(const Hierarchy<3>& hierarchy, double step)
      : hierarchy_(hierarchy),
        step_(step),
        values_(Lattice<3>(hierarchy.box(), 1).vertices(), 0.0f),
        weights_(kDecisions, Mixer<3>::initialWeights()) {}

  /// Codes the new vertices of a leaf that GateTraversal visits: positive(sample) is the sign,
  /// actual(sample) the scalar.
  template <class Coder, class Positive, class Actual>
  void code(Coder& coder, const TaggedSimplex<3>& leaf, const TaggedSimplex<3>* from, int newVertex,
            Positive positive, Actual actual) {
    for (int i = 0; i <= 3; ++i) {
      if (from != nullptr && i != newVertex) continue;
      const auto sample = hierarchy_.position(leaf.vertices[i]);
      float& value = values_[index(sample)];
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

  /// The decoded scalar, or 0 if there is none.
  [[nodiscard]] double value(const Coordinates<3>& sample) const { return values_[index(sample)]; }
  /// The number of coded scalars.
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  // Decisions: whether the magnitude is as predicted, or larger; the difference in unary; of a
  // large difference the number of further bits, and these bits.
  enum : std::size_t { kExact, kMore, kUnary, kBits = kUnary + 14, kRest = kBits + 20, kDecisions };
  static constexpr std::size_t kSizes = 8, kGuesses = 12, kErrors = 8, kBins = 16;
  static constexpr int kMost = 1 << 20;  // the largest magnitude in quantization steps

  [[nodiscard]] std::size_t index(const Coordinates<3>& v) const {
    const auto& box = hierarchy_.box();
    const auto row = static_cast<std::size_t>(v[2]) * static_cast<std::size_t>(box[1] + 1) +
                     static_cast<std::size_t>(v[1]);
    return row * static_cast<std::size_t>(box[0] + 1) + static_cast<std::size_t>(v[0]);
  }

  /// By the linear function of the leaf before. In a component's first leaf, half the leaf's size.
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

  /// Codes a magnitude in whole steps. `guess` is negative if the prediction has the opposite sign;
  /// `finer` is the number of bisections between the leaf and the finest leaves.
  template <class Coder>
  int codeSize(Coder& coder, int actual, double guess, std::size_t finer) {
    const std::size_t bySize =
                          finer * kGuesses + std::min(logarithm(std::abs(guess)), kGuesses - 1),
                      byErrors = finer * kErrors + std::min(logarithm(lastErrors_), kErrors - 1),
                      bin = static_cast<std::size_t>(std::clamp(4 * (guess + 1), 0.0, kBins - 1.0));
    const auto bit = [&](std::size_t decision, bool value) {
      const std::array<BitModel*, 3> contexts{
          &bySize_[decision][bySize], &byErrors_[decision][byErrors], &byGuess_[decision][bin]};
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

  /// Codes a difference of at least 1.
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
  double lastErrors_ = 0;  // a decaying average of the latest differences
  std::array<std::array<BitModel, kSizes * kGuesses>, kDecisions> bySize_;
  std::array<std::array<BitModel, kSizes * kErrors>, kDecisions> byErrors_;
  std::array<std::array<BitModel, kBins>, kDecisions> byGuess_;
  std::vector<Mixer<3>::Weights> weights_;
};

}  // namespace isostar::bench
