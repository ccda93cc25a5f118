// The contexts in which signs of a further isovalue are coded (§5.4).
#pragma once

#include "coding/exchange/exchange.h"
#include "estimate/prediction.h"
#include "grid/vertex_front.h"
#include "scalars/intervals.h"

namespace isostar {

/// Mixes four contexts: where the vertex's interval is cut, what its neighbours' scalars predict,
/// how many neighbours have the other sign, and which.
template <int D>
class FurtherSignContexts {
 public:
  FurtherSignContexts()
      : byInterval_(kIntervalContexts),
        byGuess_(kGuessContexts),
        byCrossings_(kCrossingContexts),
        byPattern_(kPatternContexts) {
    weights_.fill(Mixer<kInputs>::initialWeights());
  }

  /// Loads the brick that `front` has entered. `scalars`: relative to the new isovalue.
  void enter(const VertexFront<D>& front, const Scalars<D>& scalars, const BrickTable<D>& table,
             std::size_t brickIndex) {
    values_.load(scalars, table, table.brick(brickIndex));
    shapes_.load(front.window());
    if (scalars.has(brickIndex)) gradient_ = scalars.gradient(brickIndex);
    steps_ = SlopeUnit(gradient_);
  }
  /// Of the entered brick, as Scalars store it; if it has none, that of the brick entered before.
  [[nodiscard]] int gradient() const { return gradient_; }
  /// Stores a scalar of the entered brick for later contexts.
  void set(std::size_t r, int x, int32_t value) {
    values_.value[ScalarWindow<D>::index(r, x)] = value;
  }

  /// Codes whether vertex x in row r of the entered brick has another sign than at the nearest
  /// isovalue. Contexts are relative to that sign. `isoStep`: of the new isovalue; `interval`: the
  /// vertex's, perhaps without bounds; `actual`: its sign at the new isovalue.
  template <class Coder>
  bool codeFlipped(Coder& coder, const VertexFront<D>& front, std::size_t r, int x, int32_t isoStep,
                   const Interval& interval, bool actual) {
    const bool mine = front.positive(r, x);
    const Neighbours neighbours = around(front, r, x, mine);
    int64_t guess = neighbours.guess(steps_);
    if (!mine) guess = -guess;
    const auto scaled = [&](int64_t step) {
      return static_cast<std::size_t>(
          std::clamp<int64_t>(guess * 8 / step + kGuesses / 2, 0, kGuesses - 1));
    };
    const std::size_t byStep = scaled(std::max<int64_t>(1, steps_.eighth() * 8)),
                      confidence = static_cast<std::size_t>(std::min(neighbours.known, 3));
    std::size_t part = kParts, inInterval = byStep, wide = 0;
    if (interval.bounded()) {
      const int64_t width = interval.width(), mineSide = mine ? int64_t{interval.high} - isoStep
                                                              : int64_t{isoStep} - interval.low;
      part =
          static_cast<std::size_t>(std::clamp<int64_t>(mineSide * kParts / width, 0, kParts - 1));
      inInterval = scaled(2 * width);
      wide = static_cast<std::size_t>(
          std::clamp(gradient_ / 4 - (32 - std::countl_zero(interval.width())) + 2, 0, 7));
    }
    const auto sides = static_cast<std::size_t>(neighbours.crossings), quarter = part / 4;
    const std::array<BitModel*, kInputs> contexts{
        &byInterval_[(part * kGuesses + inInterval) * 4 + confidence],
        &byGuess_[(byStep * kSides + sides) * 5 + quarter],
        &byCrossings_[(sides * (kParts + 1) + part) * 8 + wide],
        &byPattern_[neighbours.pattern * 5 + quarter]};
    return Mixer<kInputs>::template bit<255, 12>(coder, actual != mine, contexts,
                                                 weights_[sides * 5 + quarter]);
  }

 private:
  static constexpr int kInputs = 4;
  static constexpr int kParts = 16;    // of an interval
  static constexpr int kGuesses = 32;  // in units of an eighth of a grid step
  static constexpr int kSides = 2 * D + 1;
  static constexpr std::size_t kIntervalContexts = (kParts + 1) * kGuesses * 4;
  static constexpr std::size_t kGuessContexts = kGuesses * kSides * 5;
  static constexpr std::size_t kCrossingContexts = kSides * (kParts + 1) * 8;
  static constexpr std::size_t kPatternContexts = (1u << (2 * D)) * 5;

  /// The neighbours of a vertex along the axes.
  struct Neighbours {
    int64_t sum = 0;       // of the known scalars
    int32_t tilt = 0;      // what their distance along the slope adds to them
    int known = 0;         // scalars
    int crossings = 0;     // neighbours of the other sign
    unsigned pattern = 0;  // which: a bit each

    /// The scalar that they predict; 0 if none is known.
    [[nodiscard]] int64_t guess(const SlopeUnit& steps) const {
      return known == 0 ? 0 : (sum - steps.times(tilt)) * reciprocal(known) >> 16;
    }
  };
  [[nodiscard]] Neighbours around(const VertexFront<D>& front, std::size_t r, int x,
                                  bool mine) const {
    const int32_t* here = &values_.value[ScalarWindow<D>::index(r, x)];
    Neighbours n;
    for (int a = 0; a < D; ++a) {
      for (int side = -1; side <= 1; side += 2) {
        const int32_t value = here[side * ScalarWindow<D>::stride(a)];
        const bool other = front.neighbour(r, x, a, side) != mine;
        n.pattern = n.pattern << 1 | (other ? 1u : 0u);
        n.crossings += other ? 1 : 0;
        if (value == Scalars<D>::kUnknown) continue;
        n.sum += value;
        n.tilt += side * shapes_.slope(a, r, x);
        ++n.known;
      }
    }
    return n;
  }

  ScalarWindow<D> values_;
  ShapeEstimate<D> shapes_{SmoothingFilter::Wide};
  int gradient_ = 4;
  SlopeUnit steps_;
  std::vector<BitModel> byInterval_, byGuess_, byCrossings_, byPattern_;
  std::array<typename Mixer<kInputs>::Weights, kSides * 5> weights_;
};

}  // namespace isostar
