// Magnitude refinement for a further isovalue (§5.4): halves the intervals known from other
// isovalues where they move the new surface.
#pragma once

#include "coding/geometry/magnitude_coder.h"
#include "scalars/intervals.h"

namespace isostar {

/// Like MagnitudeCoder, but for intervals of any width: other isovalues may have cut them anywhere.
template <int D>
class FurtherMagnitudeCoder {
 public:
  FurtherMagnitudeCoder() : models_(kContexts) {}

  using Pass = typename MagnitudeCoder<D>::Pass;

  /// `isoStep`: of the isovalue. `scalars`: the middles of the intervals relative to it.
  template <MagnitudeExchange Exchange>
  void code(Exchange& exchange, const Signs<D>& signs, int32_t isoStep, Intervals<D>& intervals,
            Scalars<D>& scalars, const Pass& pass, const std::vector<uint8_t>& active) {
    for (std::size_t brickIndex = 0; brickIndex < active.size() && !exchange.exhausted();
         ++brickIndex) {
      exchange.visit(1);
      if (active[brickIndex] == 0 || !scalars.has(brickIndex) || !intervals.has(brickIndex))
        continue;
      if (pass.selective && !selectModel_.bit(exchange.coder(), exchange.selected(brickIndex)))
        continue;
      exchange.visitBrick();
      gradient_ = scalars.gradient(brickIndex);
      farEnds_.setGradient(gradient_);
      window_.load(scalars, signs.table(), signs.table().brick(brickIndex));
      auto& brick = scalars.writable(brickIndex);
      auto& known = intervals.writable(brickIndex);
      const auto& members = brick.members[static_cast<std::size_t>(pass.members)];
      exchange.visit(members.count() * FarEnds<D>::decisionsToFind(pass.allowed));
      members.forEach([&](std::size_t r, int x) {
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        if (exchange.exhausted() || !brick.knows(v) || !known[v].bounded()) return;
        const bool positive = brick.value[v] > 0;
        farEnds_.find(window_, r, x, positive, pass.allowed);
        if (!moves(known[v], isoStep, pass.selective)) return;
        const auto guess = Interpolation<D>::of(window_, r, x, positive);
        const auto actual = static_cast<int32_t>(exchange.magnitude(brickIndex, r, x));
        const int32_t own = isoStep + (positive ? actual : -1 - actual),
                      expected = guessed(guess, positive, isoStep, known[v]);
        for (int count = 0; count < pass.most && moves(known[v], isoStep, pass.selective);
             ++count) {
          halve(exchange, known[v], expected, guess.confidence, own);
        }
        window_.value[window_.index(r, x)] = brick.value[v] = known[v].value(isoStep);
      });
    }
  }

 private:
  static constexpr int kRatios = 32;
  static constexpr std::size_t kContexts = 8 * 4 * kRatios;

  [[nodiscard]] bool moves(const Interval& interval, int32_t isoStep, bool selective) const {
    return interval.width() > 1 &&
           farEnds_.move(static_cast<uint32_t>(std::abs(interval.value(isoStep))), interval.width(),
                         selective);
  }

  /// The predicted iso step, not far outside the interval.
  static int32_t guessed(const Interpolation<D>& guess, bool positive, int32_t isoStep,
                         const Interval& interval) {
    const int64_t away = guess.magnitude / 2, at = isoStep + (positive ? away : -away);
    return static_cast<int32_t>(std::clamp<int64_t>(at, int64_t{interval.low} - interval.width(),
                                                    int64_t{interval.high} + interval.width()));
  }

  template <MagnitudeExchange Exchange>
  void halve(Exchange& exchange, Interval& interval, int32_t guess, int confidence,
             int32_t actual) {
    const auto width = static_cast<int64_t>(interval.width());
    const auto middle = static_cast<int32_t>(interval.low + width / 2);
    const int64_t offset = (int64_t{guess} - middle) * (kRatios / 2) / width;
    const auto ratio =
        static_cast<std::size_t>(std::clamp<int64_t>(offset + kRatios / 2, 0, kRatios - 1));
    const auto fineness = static_cast<std::size_t>(
        std::clamp(gradient_ / 4 - (32 - std::countl_zero(interval.width())) + 2, 0, 7));
    BitModel& probability =
        models_[(fineness * 4 + static_cast<std::size_t>(confidence)) * kRatios + ratio];
    (probability.bit(exchange.coder(), actual >= middle) ? interval.low : interval.high) = middle;
  }

  ScalarWindow<D> window_;
  int gradient_ = 0;    // of the current brick
  FarEnds<D> farEnds_;  // of the current vertex
  BitModel selectModel_;
  std::vector<BitModel> models_;
};

}  // namespace isostar
