// Magnitude refinement (§5.3): passes that halve intervals as long as they move the surface.
#pragma once

#include <bit>
#include <optional>
#include <type_traits>

#include "coding/exchange/exchange.h"
#include "coding/geometry/fit_coder.h"
#include "estimate/far_ends.h"
#include "estimate/interpolation.h"
#include "grid/tube.h"
#include "util/decodes_all.h"

namespace isostar {

/// Halves the intervals of those vertices that can still move a crossing by more than the pass
/// allows. Both sides can compute which these are.
template <int D>
class MagnitudeCoder {
 public:
  MagnitudeCoder() : models_(kContexts) {}
  /// Bytes of models beside the object, before a pass is fitted, and now.
  [[nodiscard]] static constexpr uint64_t memoryOfModels() { return kContexts * sizeof(BitModel); }
  [[nodiscard]] uint64_t memory() const {
    if constexpr (kDecodesAll) {
      if (fit_) return memoryOfModels() + FitCoder<D>::memoryOfModels();
    }
    return memoryOfModels();
  }

  using Allowed = typename FarEnds<D>::Allowed;

  /// The parameters of a pass. `most`: how often it may halve an interval. `selective`: it first
  /// codes for each brick whether it takes part. `fitted`: it codes halves with FitCoder.
  struct Pass {
    Members members = Members::AxisEnds;
    Allowed allowed{};
    int most = 1;
    bool selective = false;
    bool fitted = false;
  };

  template <MagnitudeExchange Exchange>
  void code(Exchange& exchange, const Signs<D>& signs, Scalars<D>& scalars, const Pass& pass,
            const std::vector<uint8_t>& active) {
    if constexpr (kDecodesAll) {
      if (pass.fitted && !fit_) fit_.emplace();
    }
    for (std::size_t brickIndex = 0; brickIndex < active.size() && !exchange.exhausted();
         ++brickIndex) {
      exchange.visit(1);
      if (active[brickIndex] == 0 || !scalars.has(brickIndex)) continue;
      if (pass.selective && !selectModel_.bit(exchange.coder(), exchange.selected(brickIndex)))
        continue;
      exchange.visitBrick();
      gradient_ = scalars.gradient(brickIndex);
      farEnds_.setGradient(gradient_);
      window_.load(scalars, signs.table(), signs.table().brick(brickIndex));
      if constexpr (kDecodesAll) {
        if (pass.fitted) fit_->enter(window_, gradient_);
      }
      auto& brick = scalars.writable(brickIndex);
      const auto& members = brick.members[static_cast<std::size_t>(pass.members)];
      exchange.visit(members.count() * FarEnds<D>::decisionsToFind(pass.allowed));
      members.forEach([&](std::size_t r, int x) {
        if (!exchange.exhausted()) vertex(exchange, brick, brickIndex, r, x, pass);
      });
    }
  }

 private:
  /// As Scalars store it, without the sign.
  struct Interval {
    uint32_t middle;
    int width;
  };
  struct NoFit {};
  static constexpr int kRatios = 32;
  static constexpr std::size_t kContexts = 8 * 4 * kRatios;

  template <MagnitudeExchange Exchange>
  void vertex(Exchange& exchange, typename Scalars<D>::Brick& brick, std::size_t brickIndex,
              std::size_t r, int x, const Pass& pass) {
    const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
    if (!brick.knows(v)) return;
    const bool positive = brick.value[v] > 0;
    Interval interval{brick.middle(v), brick.width(v)};
    farEnds_.find(window_, r, x, positive, pass.allowed);
    if (pass.most == 0 || !moves(interval, pass.selective)) return;
    const auto guess = Interpolation<D>::of(window_, r, x, positive);
    if constexpr (kDecodesAll) {
      if (pass.fitted) fit_->find(r, x, positive);
    }
    const auto neighbour = [&](int axis, bool ahead) {
      return window_
          .value[window_.index(r, x) + (ahead ? window_.stride(axis) : -window_.stride(axis))];
    };
    auto target = exchange.rdoqTarget(brickIndex, r, x, neighbour, pass.allowed);
    target.choose(interval.middle, uint32_t{1} << interval.width,
                  [&](uint32_t magnitude) { return settled(interval, magnitude, pass.selective); });
    int count = 0;
    do {
      halve(exchange, interval, guess, target, pass);
    } while (++count < pass.most && moves(interval, pass.selective));
    const auto middle = static_cast<int32_t>(interval.middle);
    window_.value[window_.index(r, x)] = brick.value[v] = positive ? middle : -middle;
    if constexpr (kDecodesAll) {
      if (pass.fitted) fit_->update(r, x, brick.value[v]);
    }
  }

  [[nodiscard]] bool moves(const Interval& interval, bool selective) const {
    return interval.width > 0 &&
           farEnds_.move(interval.middle, uint32_t{1} << interval.width, selective);
  }

  /// The middle of the last interval if refinement follows a magnitude. Only an encoder knows one.
  [[nodiscard]] uint32_t settled(Interval interval, uint32_t magnitude, bool selective) const {
    while (moves(interval, selective)) {
      const uint32_t half = uint32_t{1} << --interval.width;
      interval.middle += 2 * uint64_t{magnitude} >= interval.middle ? half : -half;
    }
    return interval.middle;
  }

  template <MagnitudeExchange Exchange, class Target>
  void halve(Exchange& exchange, Interval& interval, const Interpolation<D>& guess, Target& target,
             const Pass& pass) {
    const Interval whole = interval;
    const int width = --interval.width;
    // The position of the guess in the interval, in sixteenths; it may lie outside.
    const int64_t offset = ((guess.magnitude - int64_t{interval.middle}) * (kRatios / 8)) >> width;
    const auto ratio =
        static_cast<std::size_t>(std::clamp<int64_t>(offset + kRatios / 2, 0, kRatios - 1));
    const auto fineness = static_cast<std::size_t>(std::clamp(gradient_ / 4 - width, 0, 7));
    BitModel& probability =
        models_[(fineness * 4 + static_cast<std::size_t>(guess.confidence)) * kRatios + ratio];
    const bool upper = target.codeUpper(
        exchange.coder(), whole.middle,
        [&](uint32_t magnitude) { return settled(whole, magnitude, pass.selective); },
        [&](auto& coder) {
          const bool isUpper = target.upper(whole.middle);
          if constexpr (kDecodesAll) {
            if (pass.fitted)
              return fit_->upper(coder, isUpper, whole.middle, width, fineness, probability);
          }
          return probability.hotBit(coder, isUpper);
        });
    const uint32_t half = uint32_t{1} << width;
    interval.middle += upper ? half : -half;
  }

  ScalarWindow<D> window_;
  int gradient_ = 0;    // of the current brick
  FarEnds<D> farEnds_;  // of the current vertex
  BitModel selectModel_;
  std::vector<BitModel> models_;
  std::optional<std::conditional_t<kDecodesAll, FitCoder<D>, NoFit>> fit_;  // set by fitted passes
};

}  // namespace isostar
