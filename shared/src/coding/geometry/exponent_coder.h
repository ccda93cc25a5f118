// The exponent pass, the first pass of the scalars (§5.3): the position of each magnitude's highest
// bit.
#pragma once

#include <bit>

#include "coding/exchange/exchange.h"
#include "entropy/unary.h"
#include "estimate/hints.h"
#include "estimate/prediction.h"
#include "grid/tube.h"
#include "scalars/displacement_window.h"

namespace isostar {

/// Codes the exponents of |scalar| at the tube's vertices. Below a floor relative to the brick's
/// gradient, it codes only that the magnitude lies below. A crossing lies at |a| / (|a| + |b|), so
/// a factor of two means the same distance whatever the gradient.
template <int D>
class ExponentCoder {
 public:
  ExponentCoder()
      : byShape_(kShapeContexts),
        byGuess_(kGuessContexts),
        bySizes_(kSizeContexts),
        byAll_(kAllContexts) {
    weights_.fill(Mixer<kInputs>::initialWeights());
  }

  /// Codes a brick's gradient, then the exponent of each magnitude. The lowest interval is [0,
  /// 2^floor); the floor is `exponentRange` bits below the brick's gradient.
  template <MagnitudeExchange Exchange>
  void code(Exchange& exchange, const Signs<D>& signs, Scalars<D>& scalars, Members members,
            int exponentRange, const std::vector<uint8_t>& active, const Hints<D>& hints = {}) {
    hints_ = hints;
    code(exchange, signs, scalars, members, exponentRange, active, [](Tube<D>&) {});
  }

  /// The same, after choose(tube) has added or removed members.
  template <MagnitudeExchange Exchange, class Choose>
  void code(Exchange& exchange, const Signs<D>& signs, Scalars<D>& scalars, Members members,
            int exponentRange, const std::vector<uint8_t>& active, Choose choose) {
    for (std::size_t brickIndex = 0;
         brickIndex < active.size() && exchange.charge(scalars.memory()); ++brickIndex) {
      if (active[brickIndex] == 0) continue;
      exchange.visitBrick();
      tube_.enter(signs, brickIndex, members);
      choose(tube_);
      if (tube_.empty()) continue;
      if (!scalars.hasGradient(brickIndex)) codeGradient(exchange, scalars, brickIndex);
      if (exchange.exhausted()) return;  // the gradient may be noise
      brick(exchange, scalars, members, brickIndex, exponentRange);
    }
  }

 private:
  static constexpr int kMostExponents = 8;  // distinguished by contexts
  static constexpr int kGuesses = 40;       // in units of 1/4 bit
  static constexpr int kCrossings = 8;
  static constexpr int kInputs = 4;
  static constexpr std::size_t kShapeContexts = kCrossings * 64 * kMostExponents;
  static constexpr std::size_t kGuessContexts = 4 * kGuesses * 4 * kMostExponents;
  static constexpr std::size_t kSizeContexts = kCrossings * 16 * 16 * kMostExponents;
  static constexpr std::size_t kAllContexts = kGuesses * 16 * kCrossings * kMostExponents;
  static constexpr int kMostWidth = 29;
  static constexpr int kMostGradient = 4 * 31;

  /// Codes the gradient, which scales the brick's floor and contexts, as a difference to that of
  /// the brick coded before.
  template <MagnitudeExchange Exchange>
  void codeGradient(Exchange& exchange, Scalars<D>& scalars, std::size_t brickIndex) {
    const int actual = exchange.gradient(brickIndex) - lastGradient_;
    auto& coder = exchange.coder();
    const int difference = codeSignedUnary(actual, 128, [&](int n, bool answer) {
      return gradientModel_[static_cast<std::size_t>(std::min(n, 15))].bit(coder, answer);
    });
    lastGradient_ = std::clamp(lastGradient_ + difference, 0, kMostGradient);
    scalars.setGradient(brickIndex, lastGradient_);
  }

  template <MagnitudeExchange Exchange>
  void brick(Exchange& exchange, Scalars<D>& scalars, Members members, std::size_t brickIndex,
             int exponentRange) {
    auto& brick = scalars.writable(brickIndex);
    brick.members[static_cast<std::size_t>(members)] = tube_.members();
    gradient_ = scalars.gradient(brickIndex);
    floor_ = std::clamp(gradient_ / 4 - exponentRange, 0, kMostWidth);
    window_.load(scalars, tube_.table(), tube_.at());
    shapes_.load(tube_.window());
    if (hints_.displaced()) {
      displaced_.load(*hints_.displacements, tube_.table(), tube_.at());
      displaced_.spread();
    }
    const SizeUnit unit(gradient_);
    shift_ = unit.shift;
    // Positive vertices first: the negative ones then know the far ends of their crossing edges.
    for (const bool positive : {true, false})
      tube_.forEach(positive, [&](int row, std::size_t r, int x) {
        if (exchange.exhausted()) return;
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        if (brick.knows(v)) return;  // from another isovalue
        const auto guess = Prediction<D>::of(shapes_, window_, tube_, row, r, x, positive, unit,
                                             displaced_.at(r, x));
        const int exponent = codeExponent(exchange, guess, exchange.magnitude(brickIndex, r, x));
        const uint32_t low = exponent == 0 ? 0 : uint32_t{1} << (floor_ + exponent - 1);
        brick.set(v, positive, low, exponent == 0 ? floor_ : floor_ + exponent - 1);
        window_.value[window_.index(r, x)] = brick.value[v];
      });
  }

  /// A mean size relative to the gradient, 1 … 15 in units of half a bit; 0 if there is none.
  /// `size`: log2Eighths() of a sum of `count` sizes.
  [[nodiscard]] std::size_t relative(int size, int count) const {
    static constexpr std::array<int8_t, 9> kOfTwice{0,  8,  16, 21, 24,
                                                    27, 29, 30, 32};  // 8 log2 of twice the count
    const int halves =
        ((size - kOfTwice[static_cast<std::size_t>(count)]) >> 2) + 2 * shift_ - gradient_ / 2 + 11;
    return count == 0 ? 0 : static_cast<std::size_t>(std::clamp(halves, 1, 15));
  }

  /// Codes an exponent, counted from the floor: starts at the predicted one and moves up or down
  /// until it is found. The contexts of one vertex are adjacent in memory.
  template <MagnitudeExchange Exchange>
  int codeExponent(Exchange& exchange, const Prediction<D>& p, uint32_t actual) {
    const Lanes sizes = log2Eighths(Lanes{p.other, p.same, p.other + p.same, p.theirs}),
                ones = log2Eighths(Lanes{p.magnitude, p.own});
    const int toSteps = 8 * (shift_ - 1), guessed = ones[0] + toSteps;
    const int exponent = std::max(0, 32 - std::countl_zero(actual) - floor_),
              last = kMostWidth - floor_;
    // A second prediction: this vertex relates to what the signs say of it as its neighbours relate
    // to what the signs say of them.
    const int alike = p.known == 0 ? guessed : ones[1] + sizes[2] - sizes[3] + toSteps;
    const auto fromFloor = [&](int size) {
      return static_cast<std::size_t>(std::clamp((size - 8 * floor_ + 16) >> 1, 0, kGuesses - 1));
    };
    const std::size_t guess = fromFloor(guessed), ratio = fromFloor(alike),
                      other = relative(sizes[0], p.others),
                      same = relative(sizes[1], p.known - p.others);
    const auto confidence = static_cast<std::size_t>(std::min(p.known, 3)),
               shape = static_cast<std::size_t>(p.shape);
    const auto crossings = static_cast<std::size_t>(std::min(p.crossings, kCrossings - 1));
    BitModel* const byShape = &byShape_[(crossings * 64 + shape) * kMostExponents];
    BitModel* const byGuess =
        &byGuess_[((confidence * kGuesses + guess) * 4 + other / 4) * kMostExponents];
    BitModel* const bySizes = &bySizes_[((crossings * 16 + other) * 16 + same) * kMostExponents];
    BitModel* const byAll =
        &byAll_[((ratio * 16 + shape / 4) * kCrossings + crossings) * kMostExponents];
    const std::size_t trust = (other != 0 ? 1 : 0) + (same != 0 ? 2 : 0);
    auto above = [&](int k) {
      const auto at = static_cast<std::size_t>(std::min(k, kMostExponents - 1));
      return Mixer<kInputs>::template bit<127, 10>(
          exchange.coder(), exponent > k, {byShape + at, byGuess + at, bySizes + at, byAll + at},
          weights_[at * 4 + trust]);
    };
    int k = std::clamp(((guessed - 1) >> 3) + 1 - floor_, 0, last);
    const bool up = k < last && above(k);
    for (k += up ? 1 : -1; k >= 0 && k < last && above(k) == up; k += up ? 1 : -1) {
    }
    return up ? k : k + 1;
  }

  Hints<D> hints_;
  DisplacementWindow<D> displaced_;
  Tube<D> tube_;
  ScalarWindow<D> window_;
  ShapeEstimate<D> shapes_{SmoothingFilter::Wide};  // as a context the best for all levels
  int gradient_ = 0, floor_ = 0, shift_ = 0;        // of the current brick
  int lastGradient_ = 0;
  std::array<BitModel, 16> gradientModel_;
  std::vector<BitModel> byShape_, byGuess_, bySizes_, byAll_;
  std::array<Mixer<kInputs>::Weights, kMostExponents * 4> weights_;
};

}  // namespace isostar
