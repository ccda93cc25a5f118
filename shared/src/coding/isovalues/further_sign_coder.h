// Close-by isosurfaces (§5.4), first half: the signs of a further isovalue where those told do not
// imply them.
#pragma once

#include "coding/exchange/exchange.h"
#include "estimate/prediction.h"
#include "grid/vertex_front.h"
#include "scalars/intervals.h"

namespace isostar {

/// Starts from the nearest isovalue's signs. Open are the vertices between the isovalues told on
/// both sides of the new one whose known interval, if any, does not decide. Those with an interval
/// are told first; then, in a front that grows as signs turn, those beside a vertex of the other
/// sign. What is left has the nearest isovalue's sign, but for components that first appear:
/// exceptions, localized by group of bricks, brick, row and vertex, from each of which the front
/// goes on. So the signs are exactly the source's.
template <int D>
class FurtherSignCoder {
 public:
  FurtherSignCoder()
      : byInterval_(kIntervalContexts),
        byGuess_(kGuessContexts),
        byCrossings_(kCrossingContexts),
        byPattern_(kPatternContexts) {
    weights_.fill(Mixer<kInputs>::initialWeights());
  }

  /// Levels of the new isovalue and of those told next to it, null where there is none; `margin` is
  /// by how many quanta levels and signs may disagree.
  struct Task {
    int32_t isoStep = 0, margin = 0;
    const Signs<D>*below = nullptr, *above = nullptr;
    int32_t isoStepBelow = -Interval::kFar, isoStepAbove = Interval::kFar;
  };

  /// `signs` are the nearest isovalue's at first; `scalars` what intervals tell, seen from the new
  /// isovalue.
  template <SignExchange Exchange>
  [[gnu::noinline]] void code(Exchange& exchange, const Task& task, Intervals<D>& intervals,
                              Signs<D>& signs, Scalars<D>& scalars) {
    task_ = &task;
    intervals_ = &intervals;
    signs_ = &signs;
    scalars_ = &scalars;
    front_.begin(signs, task.below, task.above);
    for (std::size_t brickIndex = 0; brickIndex < front_.tableSize(); ++brickIndex)
      decide(brickIndex);
    for (std::size_t brickIndex = 0; brickIndex < front_.tableSize() && charge(exchange);
         ++brickIndex)
      codeCut(exchange, brickIndex);
    front_.queueAll();
    grow(exchange);
    for (std::size_t first = 0; first < front_.tableSize() && charge(exchange); first += kGroup) {
      group(exchange, first, std::min(first + kGroup, front_.tableSize()));
    }
    front_.end();
  }

 private:
  static constexpr int kInputs = 4;
  static constexpr int kParts = 16;    // of an interval
  static constexpr int kGuesses = 32;  // of an eighth of a step
  static constexpr int kSides = 2 * D + 1;
  static constexpr std::size_t kGroup = 64;  // bricks in a row that share a flag
  static constexpr std::size_t kIntervalContexts = (kParts + 1) * kGuesses * 4;
  static constexpr std::size_t kGuessContexts = kGuesses * kSides * 5;
  static constexpr std::size_t kCrossingContexts = kSides * (kParts + 1) * 8;
  static constexpr std::size_t kPatternContexts = (1u << (2 * D)) * 5;

  template <SignExchange Exchange>
  bool charge(Exchange& exchange) const {
    return exchange.charge(signs_->memory() + scalars_->memory() + intervals_->memory() +
                           front_.memory());
  }

  /// Does a known interval lie on one side?
  [[nodiscard]] bool above(const Interval& i) const {
    return i.low >= task_->isoStep + task_->margin;
  }
  [[nodiscard]] bool below(const Interval& i) const {
    return i.high <= task_->isoStep - task_->margin;
  }

  /// Closes the vertices of a brick that their intervals decide.
  void decide(std::size_t brickIndex) {
    if (!intervals_->has(brickIndex) || !front_.open(brickIndex)) return;
    const auto& known = intervals_->at(brickIndex);
    for (std::size_t r = 0; r < kRows; ++r) {
      for (uint32_t open = front_.openRow(brickIndex, r); open != 0; open &= open - 1) {
        const int x = std::countr_zero(open);
        const Interval& interval = known[vertexOf(r, x)];
        if (interval.bounded() && (above(interval) || below(interval)))
          front_.close(brickIndex, r, x, above(interval));
      }
    }
  }

  /// Tells the vertices of a brick whose intervals the new isovalue cuts.
  template <SignExchange Exchange>
  void codeCut(Exchange& exchange, std::size_t brickIndex) {
    if (!intervals_->has(brickIndex) || !front_.open(brickIndex)) return;
    const auto& known = intervals_->at(brickIndex);
    bool entered = false;
    for (std::size_t r = 0; r < kRows; ++r) {
      for (uint32_t open = front_.openRow(brickIndex, r); open != 0; open &= open - 1) {
        const int x = std::countr_zero(open);
        if (!known[vertexOf(r, x)].bounded()) continue;
        if (!entered) enter(brickIndex);
        entered = true;
        codeVertex(exchange, brickIndex, r, x);
      }
    }
    front_.leave();
  }

  template <SignExchange Exchange>
  [[gnu::noinline]] void grow(Exchange& exchange) {
    while (const auto brickIndex = front_.next()) {
      if (!charge(exchange)) return;
      enter(*brickIndex);
      for (bool more = true; more;) {
        more = false;
        for (std::size_t r = 0; r < kRows; ++r) {
          while (const uint32_t beside = front_.beside(*brickIndex, r)) {
            if (exchange.exhausted()) return;
            codeVertex(exchange, *brickIndex, r, std::countr_zero(beside));
            more = true;
          }
        }
      }
      front_.leave();
    }
  }

  /// Components that first appear.
  template <SignExchange Exchange>
  void group(Exchange& exchange, std::size_t first, std::size_t end) {
    bool any = false, open = false;
    for (std::size_t brickIndex = first; brickIndex < end; ++brickIndex) {
      open = open || front_.open(brickIndex);
      any = any || hasNewComponents(exchange, brickIndex);
    }
    if (!open || !groupFlag_.bit(exchange.coder(), any)) return;
    for (std::size_t brickIndex = first; brickIndex < end && charge(exchange); ++brickIndex) {
      if (!front_.open(brickIndex) ||
          !brickFlag_.bit(exchange.coder(), hasNewComponents(exchange, brickIndex)))
        continue;
      for (std::size_t r = 0; r < kRows; ++r) row(exchange, brickIndex, r);
    }
  }

  template <SignExchange Exchange>
  [[gnu::noinline]] bool hasNewComponents(Exchange& exchange, std::size_t brickIndex) const {
    if (!front_.open(brickIndex)) return false;
    const uint32_t index = signs_->slot(brickIndex);
    if (index <= Signs<D>::kPositive && !exchange.varies(brickIndex, index)) return false;
    uint32_t any = 0;
    for (std::size_t r = 0; r < kRows; ++r) any |= exceptions(exchange, brickIndex, r);
    return any != 0;
  }

  template <SignExchange Exchange>
  uint32_t exceptions(Exchange& exchange, std::size_t brickIndex, std::size_t r) const {
    return (exchange.row(brickIndex, r) ^ signs_->brickAt(brickIndex).rows[r]) &
           front_.openRow(brickIndex, r);
  }

  template <SignExchange Exchange>
  void row(Exchange& exchange, std::size_t brickIndex, std::size_t r) {
    if (front_.openRow(brickIndex, r) == 0 ||
        !rowFlag_.bit(exchange.coder(), exceptions(exchange, brickIndex, r) != 0))
      return;
    for (int x = 0; x < kBrickSide && charge(exchange); ++x) {
      if ((front_.openRow(brickIndex, r) >> x & 1) == 0) continue;
      if (!vertexFlag_.bit(exchange.coder(), (exceptions(exchange, brickIndex, r) >> x & 1) != 0))
        continue;
      enter(brickIndex);
      settle(brickIndex, r, x, !front_.positive(r, x));
      front_.leave();
      grow(exchange);
    }
  }

  [[gnu::noinline]] void enter(std::size_t brickIndex) {
    front_.enter(brickIndex);
    values_.load(*scalars_, signs_->table(), signs_->table().brick(brickIndex));
    shapes_.load(front_.window());
    if (scalars_->has(brickIndex)) gradient_ = scalars_->gradient(brickIndex);
    steps_ = SlopeUnit(gradient_);
  }

  template <SignExchange Exchange>
  [[gnu::noinline]] void codeVertex(Exchange& exchange, std::size_t brickIndex, std::size_t r,
                                    int x) {
    const bool flipped = codeFlipped(exchange, r, x, known(brickIndex, vertexOf(r, x)),
                                     (exchange.row(brickIndex, r) >> x & 1) != 0);
    settle(brickIndex, r, x, flipped != front_.positive(r, x));
  }

  /// Has the vertex another sign than at the nearest isovalue? Contexts are seen from that sign's
  /// side.
  template <SignExchange Exchange>
  bool codeFlipped(Exchange& exchange, std::size_t r, int x, const Interval& interval,
                   bool actual) {
    const bool mine = front_.positive(r, x);
    const int32_t* here = &values_.value[ScalarWindow<D>::index(r, x)];
    int64_t sum = 0;
    int32_t tilt = 0;
    int count = 0, crossings = 0;
    unsigned pattern = 0;
    for (int a = 0; a < D; ++a) {
      for (int side = -1; side <= 1; side += 2) {
        const int32_t value = here[side * ScalarWindow<D>::stride(a)];
        const bool other = front_.neighbour(r, x, a, side) != mine;
        pattern = pattern << 1 | (other ? 1u : 0u);
        crossings += other ? 1 : 0;
        if (value == Scalars<D>::kUnknown) continue;
        sum += value;
        tilt += side * shapes_.slope(a, r, x);
        ++count;
      }
    }
    int64_t guess = count == 0 ? 0 : (sum - steps_.times(tilt)) * reciprocal(count) >> 16;
    if (!mine) guess = -guess;
    const auto scaled = [&](int64_t step) {
      return static_cast<std::size_t>(
          std::clamp<int64_t>(guess * 8 / step + kGuesses / 2, 0, kGuesses - 1));
    };
    const std::size_t byStep = scaled(std::max<int64_t>(1, steps_.eighth() * 8)),
                      confidence = static_cast<std::size_t>(std::min(count, 3));
    std::size_t part = kParts, inInterval = byStep, wide = 0;
    if (interval.bounded()) {
      const int64_t width = interval.width(),
                    mineSide = mine ? int64_t{interval.high} - task_->isoStep
                                    : int64_t{task_->isoStep} - interval.low;
      part =
          static_cast<std::size_t>(std::clamp<int64_t>(mineSide * kParts / width, 0, kParts - 1));
      inInterval = scaled(2 * width);
      wide = static_cast<std::size_t>(
          std::clamp(gradient_ / 4 - (32 - std::countl_zero(interval.width())) + 2, 0, 7));
    }
    const auto sides = static_cast<std::size_t>(crossings), quarter = part / 4;
    const std::array<BitModel*, kInputs> contexts{
        &byInterval_[(part * kGuesses + inInterval) * 4 + confidence],
        &byGuess_[(byStep * kSides + sides) * 5 + quarter],
        &byCrossings_[(sides * (kParts + 1) + part) * 8 + wide],
        &byPattern_[pattern * 5 + quarter]};
    return Mixer<kInputs>::template bit<255, 12>(exchange.coder(), actual != mine, contexts,
                                                 weights_[sides * 5 + quarter]);
  }

  /// What scalars tell of an open vertex, or else the signs on both sides.
  [[nodiscard]] Interval known(std::size_t brickIndex, std::size_t v) const {
    const Interval& interval = intervals_->at(brickIndex)[v];
    return interval.bounded() ? interval : Interval{task_->isoStepBelow, task_->isoStepAbove};
  }

  /// A sign that is known now cuts the interval, and bounds one that had no bounds.
  void settle(std::size_t brickIndex, std::size_t r, int x, bool positive) {
    front_.close(brickIndex, r, x, positive);
    const std::size_t v = vertexOf(r, x);
    const Interval interval = known(brickIndex, v).cut(task_->isoStep, positive);
    if (!interval.bounded()) return;
    intervals_->writable(brickIndex)[v] = interval;
    if (!scalars_->has(brickIndex)) scalars_->setGradient(brickIndex, gradient_);
    scalars_->writable(brickIndex).value[v] = values_.value[ScalarWindow<D>::index(r, x)] =
        interval.value(task_->isoStep);
  }

  static constexpr std::size_t kRows = power(kBrickSide, D - 1);
  static std::size_t vertexOf(std::size_t r, int x) {
    return r * kBrickSide + static_cast<std::size_t>(x);
  }

  const Task* task_ = nullptr;
  Intervals<D>* intervals_ = nullptr;
  Signs<D>* signs_ = nullptr;
  Scalars<D>* scalars_ = nullptr;
  VertexFront<D> front_;
  ScalarWindow<D> values_;
  ShapeEstimate<D> shapes_{SmoothingFilter::Wide};
  int gradient_ = 4;
  SlopeUnit steps_;
  std::vector<BitModel> byInterval_, byGuess_, byCrossings_, byPattern_;
  std::array<typename Mixer<kInputs>::Weights, kSides * 5> weights_;
  BitModel groupFlag_, brickFlag_, rowFlag_, vertexFlag_;
};

}  // namespace isostar
