// The signs of a further isovalue (§5.4), where coded isovalues do not imply them.
#pragma once

#include "coding/exchange/exchange.h"
#include "coding/isovalues/further_sign_contexts.h"

namespace isostar {

/// Starts with the signs of the nearest coded isovalue. Open are those vertices that lie between
/// the coded isovalues on both sides, unless a known interval decides their sign. Vertices with an
/// interval are coded first. Then a front is coded, which grows as signs change: the vertices
/// beside one of the other sign. All others keep the nearest isovalue's sign, except in new
/// components; these are localized by group of bricks, brick, row and vertex, and the front
/// continues from each. So all signs are exactly the source's.
template <int D>
class FurtherSignCoder {
 public:
  /// The new isovalue among the coded ones: its iso step, and signs and iso steps of its neighbours
  /// on both sides (null if there is none). `margin`: by how many quantization steps iso steps and
  /// signs may disagree.
  struct Position {
    int32_t isoStep = 0, margin = 0;
    const Signs<D>*below = nullptr, *above = nullptr;
    int32_t isoStepBelow = -Interval::kFar, isoStepAbove = Interval::kFar;
  };

  /// `signs`: at first those of the nearest isovalue. `scalars`: the middles of the intervals
  /// relative to the new isovalue.
  template <SignExchange Exchange>
  [[gnu::noinline]] void code(Exchange& exchange, const Position& position, Intervals<D>& intervals,
                              Signs<D>& signs, Scalars<D>& scalars) {
    position_ = &position;
    intervals_ = &intervals;
    signs_ = &signs;
    scalars_ = &scalars;
    front_.begin(signs, position.below, position.above);
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
  static constexpr std::size_t kGroup = 64;  // consecutive bricks that share a flag

  template <SignExchange Exchange>
  bool charge(Exchange& exchange) const {
    return exchange.charge(signs_->memory() + scalars_->memory() + intervals_->memory() +
                           front_.memory());
  }

  /// Does a known interval lie on one side?
  [[nodiscard]] bool above(const Interval& i) const {
    return i.low >= position_->isoStep + position_->margin;
  }
  [[nodiscard]] bool below(const Interval& i) const {
    return i.high <= position_->isoStep - position_->margin;
  }

  /// Closes the vertices of a brick whose intervals decide their sign.
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

  /// Codes the vertices of a brick whose intervals contain the new isovalue.
  template <SignExchange Exchange>
  void codeCut(Exchange& exchange, std::size_t brickIndex) {
    if (!intervals_->has(brickIndex) || !front_.open(brickIndex)) return;
    const auto& known = intervals_->at(brickIndex);
    bool entered = false;
    for (std::size_t r = 0; r < kRows; ++r) {
      for (uint32_t open = front_.openRow(brickIndex, r); open != 0; open &= open - 1) {
        const int x = std::countr_zero(open);
        if (!known[vertexOf(r, x)].bounded()) continue;
        if (!entered) enter(exchange, brickIndex);
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
      enter(exchange, *brickIndex);
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

  /// Codes new components in a group of bricks.
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
    for (std::size_t r = 0; r < kRows; ++r) any |= mispredicted(exchange, brickIndex, r);
    return any != 0;
  }

  template <SignExchange Exchange>
  uint32_t mispredicted(Exchange& exchange, std::size_t brickIndex, std::size_t r) const {
    return (exchange.row(brickIndex, r) ^ signs_->brickAt(brickIndex).rows[r]) &
           front_.openRow(brickIndex, r);
  }

  template <SignExchange Exchange>
  void row(Exchange& exchange, std::size_t brickIndex, std::size_t r) {
    if (front_.openRow(brickIndex, r) == 0 ||
        !rowFlag_.bit(exchange.coder(), mispredicted(exchange, brickIndex, r) != 0))
      return;
    for (int x = 0; x < kBrickSide && charge(exchange); ++x) {
      if ((front_.openRow(brickIndex, r) >> x & 1) == 0) continue;
      if (!vertexFlag_.bit(exchange.coder(), (mispredicted(exchange, brickIndex, r) >> x & 1) != 0))
        continue;
      enter(exchange, brickIndex);
      settle(brickIndex, r, x, !front_.positive(r, x));
      front_.leave();
      grow(exchange);
    }
  }

  template <SignExchange Exchange>
  [[gnu::noinline]] void enter(Exchange& exchange, std::size_t brickIndex) {
    exchange.visitBrick();
    front_.enter(brickIndex);
    contexts_.enter(front_, *scalars_, signs_->table(), brickIndex);
  }

  template <SignExchange Exchange>
  [[gnu::noinline]] void codeVertex(Exchange& exchange, std::size_t brickIndex, std::size_t r,
                                    int x) {
    const bool flipped = contexts_.codeFlipped(exchange.coder(), front_, r, x, position_->isoStep,
                                               known(brickIndex, vertexOf(r, x)),
                                               (exchange.row(brickIndex, r) >> x & 1) != 0);
    settle(brickIndex, r, x, flipped != front_.positive(r, x));
  }

  /// The interval of an open vertex, or else the range between the isovalues on both sides.
  [[nodiscard]] Interval known(std::size_t brickIndex, std::size_t v) const {
    const Interval& interval = intervals_->at(brickIndex)[v];
    return interval.bounded() ? interval
                              : Interval{position_->isoStepBelow, position_->isoStepAbove};
  }

  /// A known sign cuts the vertex's interval, and bounds one that had no bounds.
  void settle(std::size_t brickIndex, std::size_t r, int x, bool positive) {
    front_.close(brickIndex, r, x, positive);
    const std::size_t v = vertexOf(r, x);
    const Interval interval = known(brickIndex, v).cut(position_->isoStep, positive);
    if (!interval.bounded()) return;
    intervals_->writable(brickIndex)[v] = interval;
    if (!scalars_->has(brickIndex)) scalars_->setGradient(brickIndex, contexts_.gradient());
    const int32_t value = interval.value(position_->isoStep);
    scalars_->writable(brickIndex).value[v] = value;
    contexts_.set(r, x, value);
  }

  static constexpr std::size_t kRows = power(kBrickSide, D - 1);
  static std::size_t vertexOf(std::size_t r, int x) {
    return r * kBrickSide + static_cast<std::size_t>(x);
  }

  const Position* position_ = nullptr;
  Intervals<D>* intervals_ = nullptr;
  Signs<D>* signs_ = nullptr;
  Scalars<D>* scalars_ = nullptr;
  VertexFront<D> front_;
  FurtherSignContexts<D> contexts_;
  BitModel groupFlag_, brickFlag_, rowFlag_, vertexFlag_;
};

}  // namespace isostar
