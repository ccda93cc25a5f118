// Close-by isosurfaces (§5.4), first half: the signs of a further isovalue where those told do not imply them.
#pragma once

#include "coding/exchange/exchange.h"
#include "scalars/intervals.h"
#include "estimate/prediction.h"
#include "grid/vertex_front.h"

namespace isostar {

/// Starts from the nearest isovalue's signs. Open are the vertices between the isovalues told on both sides of the new
/// one whose known interval, if any, does not decide. Those with an interval are told first; then, in a front that grows
/// as signs turn, those beside a vertex of the other sign. What is left has the nearest isovalue's sign, but for
/// components that first appear: exceptions, localized by group of bricks, brick, row and vertex, from each of which the
/// front goes on. So the signs are exactly the source's.
template <int D>
class NearSignsCoder {
 public:
  NearSignsCoder() : byInterval_(kIntervalContexts), byGuess_(kGuessContexts), byCrossings_(kCrossingContexts), byPattern_(kPatternContexts) {
    weights_.fill(Mixer<kInputs>::fresh());
  }

  /// Levels of the new isovalue and of those told next to it, null where there is none; `margin` is by how many quanta
  /// levels and signs may disagree.
  struct Task {
    int32_t level = 0, margin = 0;
    const Signs<D>*below = nullptr, *above = nullptr;
    int32_t levelBelow = -Interval::kFar, levelAbove = Interval::kFar;
  };

  /// `signs` are the nearest isovalue's at first; `scalars` what intervals tell, seen from the new isovalue.
  template <class Exchange>
  [[gnu::noinline]] void tell(Exchange& ask, const Task& task, Intervals<D>& intervals, Signs<D>& signs, Scalars<D>& scalars) {
    task_ = &task;
    intervals_ = &intervals;
    signs_ = &signs;
    scalars_ = &scalars;
    front_.begin(signs, task.below, task.above);
    for (std::size_t place = 0; place < front_.places(); ++place) decide(place);
    for (std::size_t place = 0; place < front_.places() && !spent(ask); ++place) tellCut(ask, place);
    front_.queueAll();
    grow(ask);
    for (std::size_t first = 0; first < front_.places() && !spent(ask); first += kGroup) {
      group(ask, first, std::min(first + kGroup, front_.places()));
    }
    front_.end();
  }

 private:
  static constexpr int kInputs = 4;
  static constexpr int kParts = 16;   // of an interval
  static constexpr int kGuesses = 32;  // of an eighth of a step
  static constexpr int kSides = 2 * D + 1;
  static constexpr std::size_t kGroup = 64;  // bricks in a row that share a flag
  static constexpr std::size_t kIntervalContexts = (kParts + 1) * kGuesses * 4;
  static constexpr std::size_t kGuessContexts = kGuesses * kSides * 5;
  static constexpr std::size_t kCrossingContexts = kSides * (kParts + 1) * 8;
  static constexpr std::size_t kPatternContexts = (1u << (2 * D)) * 5;

  template <class Exchange>
  bool spent(Exchange& ask) const {
    return ask.spent(signs_->memory() + scalars_->memory() + intervals_->memory() + front_.memory());
  }

  /// Does a known interval lie on one side?
  [[nodiscard]] bool above(const Interval& i) const { return i.low >= task_->level + task_->margin; }
  [[nodiscard]] bool below(const Interval& i) const { return i.high <= task_->level - task_->margin; }

  /// Closes the vertices of a brick that their intervals decide.
  void decide(std::size_t place) {
    if (!intervals_->has(place) || !front_.open(place)) return;
    const auto& known = intervals_->at(place);
    for (std::size_t r = 0; r < kRows; ++r) {
      for (uint32_t open = front_.openRow(place, r); open != 0; open &= open - 1) {
        const int x = std::countr_zero(open);
        const Interval& interval = known[vertexOf(r, x)];
        if (interval.bounded() && (above(interval) || below(interval))) front_.close(place, r, x, above(interval));
      }
    }
  }

  /// Tells the vertices of a brick whose intervals the new isovalue cuts.
  template <class Exchange>
  void tellCut(Exchange& ask, std::size_t place) {
    if (!intervals_->has(place) || !front_.open(place)) return;
    const auto& known = intervals_->at(place);
    bool entered = false;
    for (std::size_t r = 0; r < kRows; ++r) {
      for (uint32_t open = front_.openRow(place, r); open != 0; open &= open - 1) {
        const int x = std::countr_zero(open);
        if (!known[vertexOf(r, x)].bounded()) continue;
        if (!entered) enter(place);
        entered = true;
        tellVertex(ask, place, r, x);
      }
    }
    front_.leave();
  }

  template <class Exchange>
  [[gnu::noinline]] void grow(Exchange& ask) {
    while (const auto place = front_.next()) {
      if (spent(ask)) return;
      enter(*place);
      for (bool more = true; more;) {
        more = false;
        for (std::size_t r = 0; r < kRows; ++r) {
          while (const uint32_t beside = front_.beside(*place, r)) {
            if (ask.spent()) return;
            tellVertex(ask, *place, r, std::countr_zero(beside));
            more = true;
          }
        }
      }
      front_.leave();
    }
  }

  /// Components that first appear.
  template <class Exchange>
  void group(Exchange& ask, std::size_t first, std::size_t end) {
    bool any = false, open = false;
    for (std::size_t place = first; place < end; ++place) {
      open = open || front_.open(place);
      any = any || hasExceptions(ask, place);
    }
    if (!open || !groupFlag_.bit(ask.coder(), any)) return;
    for (std::size_t place = first; place < end && !spent(ask); ++place) {
      if (!front_.open(place) || !brickFlag_.bit(ask.coder(), hasExceptions(ask, place))) continue;
      for (std::size_t r = 0; r < kRows; ++r) row(ask, place, r);
    }
  }

  template <class Exchange>
  [[gnu::noinline]] bool hasExceptions(Exchange& ask, std::size_t place) const {
    if (!front_.open(place)) return false;
    const uint32_t index = signs_->index(place);
    if (index <= Signs<D>::kPositive && !ask.varies(place, index)) return false;
    uint32_t any = 0;
    for (std::size_t r = 0; r < kRows; ++r) any |= exceptions(ask, place, r);
    return any != 0;
  }

  template <class Exchange>
  uint32_t exceptions(Exchange& ask, std::size_t place, std::size_t r) const {
    return (ask.row(place, r) ^ signs_->brickAt(place).rows[r]) & front_.openRow(place, r);
  }

  template <class Exchange>
  void row(Exchange& ask, std::size_t place, std::size_t r) {
    if (front_.openRow(place, r) == 0 || !rowFlag_.bit(ask.coder(), exceptions(ask, place, r) != 0)) return;
    for (int x = 0; x < kBrickSide && !spent(ask); ++x) {
      if ((front_.openRow(place, r) >> x & 1) == 0) continue;
      if (!vertexFlag_.bit(ask.coder(), (exceptions(ask, place, r) >> x & 1) != 0)) continue;
      enter(place);
      settle(place, r, x, !front_.positive(r, x));
      front_.leave();
      grow(ask);
    }
  }

  [[gnu::noinline]] void enter(std::size_t place) {
    front_.enter(place);
    values_.load(*scalars_, signs_->table(), signs_->table().brick(place));
    shapes_.load(front_.window());
    if (scalars_->has(place)) gradient_ = scalars_->gradient(place);
    steps_ = Steps(gradient_);
  }

  template <class Exchange>
  [[gnu::noinline]] void tellVertex(Exchange& ask, std::size_t place, std::size_t r, int x) {
    const bool turned = tellTurned(ask, r, x, known(place, vertexOf(r, x)), (ask.row(place, r) >> x & 1) != 0);
    settle(place, r, x, turned != front_.positive(r, x));
  }

  /// Has the vertex another sign than at the nearest isovalue? Contexts are seen from that sign's side.
  template <class Exchange>
  bool tellTurned(Exchange& ask, std::size_t r, int x, const Interval& interval, bool truth) {
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
    const auto scaled = [&](int64_t step) { return static_cast<std::size_t>(std::clamp<int64_t>(guess * 8 / step + kGuesses / 2, 0, kGuesses - 1)); };
    const std::size_t byStep = scaled(std::max<int64_t>(1, steps_.eighth() * 8)), confidence = static_cast<std::size_t>(std::min(count, 3));
    std::size_t part = kParts, inInterval = byStep, wide = 0;
    if (interval.bounded()) {
      const int64_t width = interval.width(), mineSide = mine ? int64_t{interval.high} - task_->level : int64_t{task_->level} - interval.low;
      part = static_cast<std::size_t>(std::clamp<int64_t>(mineSide * kParts / width, 0, kParts - 1));
      inInterval = scaled(2 * width);
      wide = static_cast<std::size_t>(std::clamp(gradient_ / 4 - (32 - std::countl_zero(interval.width())) + 2, 0, 7));
    }
    const auto sides = static_cast<std::size_t>(crossings), quarter = part / 4;
    const std::array<Chance*, kInputs> contexts{&byInterval_[(part * kGuesses + inInterval) * 4 + confidence],
                                                &byGuess_[(byStep * kSides + sides) * 5 + quarter],
                                                &byCrossings_[(sides * (kParts + 1) + part) * 8 + wide], &byPattern_[pattern * 5 + quarter]};
    return Mixer<kInputs>::template bit<255, 12>(ask.coder(), truth != mine, contexts, weights_[sides * 5 + quarter]);
  }

  /// What scalars tell of an open vertex, or else the signs on both sides.
  [[nodiscard]] Interval known(std::size_t place, std::size_t v) const {
    const Interval& interval = intervals_->at(place)[v];
    return interval.bounded() ? interval : Interval{task_->levelBelow, task_->levelAbove};
  }

  /// A sign that is known now cuts the interval, and bounds one that had no bounds.
  void settle(std::size_t place, std::size_t r, int x, bool positive) {
    front_.close(place, r, x, positive);
    const std::size_t v = vertexOf(r, x);
    const Interval interval = known(place, v).cut(task_->level, positive);
    if (!interval.bounded()) return;
    intervals_->writable(place)[v] = interval;
    if (!scalars_->has(place)) scalars_->setGradient(place, gradient_);
    scalars_->writable(place).value[v] = values_.value[ScalarWindow<D>::index(r, x)] = interval.value(task_->level);
  }

  static constexpr std::size_t kRows = power(kBrickSide, D - 1);
  static std::size_t vertexOf(std::size_t r, int x) { return r * kBrickSide + static_cast<std::size_t>(x); }

  const Task* task_ = nullptr;
  Intervals<D>* intervals_ = nullptr;
  Signs<D>* signs_ = nullptr;
  Scalars<D>* scalars_ = nullptr;
  VertexFront<D> front_;
  ScalarWindow<D> values_;
  ShapeEstimate<D> shapes_{Kernel::Wide};
  int gradient_ = 4;
  Steps steps_;
  std::vector<Chance> byInterval_, byGuess_, byCrossings_, byPattern_;
  std::array<typename Mixer<kInputs>::Weights, kSides * 5> weights_;
  Chance groupFlag_, brickFlag_, rowFlag_, vertexFlag_;
};

}  // namespace isostar
