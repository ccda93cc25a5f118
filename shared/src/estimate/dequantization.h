// Dequantization: where in its interval a scalar is shown while the interval is wide, from the
// scalars around it; for display only.
#pragma once

#include <span>

#include "estimate/local_fit.h"
#include "grid/refined_signs.h"
#include "util/cold_path.h"

namespace isostar {

/// Moves the known scalars of `shown`, which count 2^-finer half quantization steps, towards what a
/// local fit says of each, within their intervals. How far the fits of a brick lie from the coded
/// intervals says how far to trust them there; where the field is rough, they are not trusted.
template <int D>
class Dequantization {
 public:
  /// `coded`: the intervals, as coded. `only`: by brick index, whether to process the brick; empty:
  /// all.
  ISOSTAR_COLD static void apply(const BrickTable<D>& table, const Scalars<D>& coded, int finer,
                                 Scalars<D>& shown, std::span<const uint8_t> only = {}) {
    Dequantization dequantization;
    for (std::size_t brickIndex = 0; brickIndex < coded.tableSize(); ++brickIndex) {
      if (coded.has(brickIndex) && (only.empty() || only[brickIndex] != 0))
        dequantization.brick(table, coded, brickIndex, finer, shown);
    }
  }

 private:
  /// log2 of half an interval in the window's scale; beyond it nothing is known.
  static constexpr int kMostHalf = 20;
  static constexpr int64_t kFarthest = 4;  // in half intervals: fits further off are clamped to it
  static constexpr int64_t kInner =
      11;  // in sixteenths of half an interval: the furthest that a scalar is moved
  static constexpr int kGainBits = 12;

  [[gnu::noinline]] void brick(const BrickTable<D>& table, const Scalars<D>& coded,
                               std::size_t brickIndex, int finer, Scalars<D>& shown) {
    const auto& intervals = coded.at(brickIndex);
    if (refined(intervals)) return;
    window_.load(coded, table, table.brick(brickIndex));
    fits_.load(window_, coded.gradient(brickIndex));
    find(intervals);
    if (count_ == 0) return;
    const Gains gains = findGains();
    auto& values = shown.writable(brickIndex).value;
    for (std::size_t i = 0; i < count_; ++i) {
      const Move& move = moves_[i];
      const int64_t most = (int64_t{kInner} << move.log2Half) / 16;
      const int64_t by = std::clamp(
          gains[static_cast<std::size_t>(move.log2Half)] * move.offset >> kGainBits, -most, most);
      const int shift = finer - fits_.up();
      const int64_t middle = int64_t{intervals.middle(move.vertex)} << finer;
      const auto magnitude = static_cast<int32_t>(
          std::max<int64_t>(middle + (shift >= 0 ? by << shift : by >> -shift), 1));
      values[move.vertex] = intervals.value[move.vertex] > 0 ? magnitude : -magnitude;
    }
  }

  /// Finds the brick's vertices that a fit may move: not those whose interval is a single
  /// quantization step, which are known, nor those of which next to nothing is known.
  void find(const typename Scalars<D>::Brick& intervals) {
    count_ = 0;
    for (const auto& members : intervals.members) {
      members.forEach([&](std::size_t r, int x) {
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        if (!intervals.knows(v) || intervals.width(v) == 0 || count_ == moves_.size()) return;
        const int log2Half = intervals.width(v) + fits_.up();
        if (log2Half < 0 || log2Half > kMostHalf) return;
        const auto fit = LocalFit<D>::of(fits_, r, x, intervals.value[v] > 0);
        if (fit.known == 0) return;
        const int32_t farthest = kFarthest << log2Half;
        const int32_t offset =
            std::clamp(fit.curved - fits_.scaled(static_cast<int32_t>(intervals.middle(v))),
                       -farthest, farthest);
        moves_[count_++] = {static_cast<uint32_t>(v), log2Half, offset};
      });
    }
  }

  /// Has a magnitude refinement pass reached the brick? If so, its intervals are shown as coded.
  /// Intervals of exponents are [0, 2^n) and [2^n, 2^(n + 1)).
  static bool refined(const typename Scalars<D>::Brick& intervals) {
    for (std::size_t v = 0; v < Scalars<D>::kVertices; ++v) {
      if (intervals.knows(v) && intervals.middle(v) >> intervals.width(v) > 3) return true;
    }
    return false;
  }

  using Gains = std::array<int64_t, kMostHalf + 1>;  // in 2^-kGainBits, by log2 of half an interval

  /// The scalar is uniformly distributed in its interval, with variance half²/3, and the fit is off
  /// with a variance of its own. The gain is the part of the way from the middle to the fit at
  /// which the best estimate lies. The mean square of the offsets is the sum of both variances; the
  /// fit's is taken to be at least a tenth of the interval's.
  [[nodiscard]] Gains findGains() const {
    const auto variance = [](int log2Half) { return (int64_t{1} << (2 * log2Half)) / 3; };
    int64_t squares = 0, spread = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      squares += int64_t{moves_[i].offset} * moves_[i].offset;
      spread += variance(moves_[i].log2Half);
    }
    const int64_t off = std::max(squares - spread, spread / 10) / static_cast<int64_t>(count_);
    Gains gains;
    for (int log2Half = 0; log2Half <= kMostHalf; ++log2Half) {
      const int64_t own = variance(log2Half);
      gains[static_cast<std::size_t>(log2Half)] = (own << kGainBits) / (own + off + 1);
    }
    return gains;
  }

  struct Move {
    uint32_t vertex;
    /// log2 of half the interval; the fit less the interval's middle; both in the window's scale.
    int32_t log2Half, offset;
  };

  ScalarWindow<D> window_;
  FitWindow<D> fits_;
  std::array<Move, Scalars<D>::kVertices> moves_;  // of the current brick
  std::size_t count_ = 0;
};

}  // namespace isostar
