// Where in their intervals scalars are shown as long as these are wide: nearer to where those
// around them put them, for display only.
#pragma once

#include <span>

#include "estimate/local_fit.h"
#include "grid/refined_signs.h"
#include "util/cold_path.h"

namespace isostar {

/// Moves the told scalars of `shown`, which count 2^-finer half quanta, towards what a fit says of
/// each, within their intervals. How far the fits of a brick lie from what has been told says how
/// much they are worth there: where the field is rough, nothing.
template <int D>
class Dequantization {
 public:
  /// `only`: the bricks that matter, by place; all if there are none.
  ISOSTAR_COLD static void apply(const BrickTable<D>& table, const Scalars<D>& coded, int finer,
                                 Scalars<D>& shown, std::span<const uint8_t> only = {}) {
    Dequantization smoothing;
    for (std::size_t brickIndex = 0; brickIndex < coded.tableSize(); ++brickIndex) {
      if (coded.has(brickIndex) && (only.empty() || only[brickIndex] != 0))
        smoothing.brick(table, coded, brickIndex, finer, shown);
    }
  }

 private:
  static constexpr int kMostHalf =
      20;  // log2 of half an interval, as the window is scaled: beyond it nothing is known
  static constexpr int64_t kFarthest = 4;  // halves of an interval: fits farther off count as that
  static constexpr int64_t kInner =
      11;  // sixteenths of half an interval: as far as a scalar is moved
  static constexpr int kGainBits = 12;

  void brick(const BrickTable<D>& table, const Scalars<D>& coded, std::size_t brickIndex, int finer,
             Scalars<D>& shown) {
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

  /// The brick's vertices that a fit may move: not those whose intervals are single quanta, which
  /// are known, or next to nothing.
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
            std::clamp(fit.bent - fits_.scaled(static_cast<int32_t>(intervals.middle(v))),
                       -farthest, farthest);
        moves_[count_++] = {static_cast<uint32_t>(v), log2Half, offset};
      });
    }
  }

  /// Has a pass that ends within come so far? Where it has, what it told is shown as it is: octaves
  /// are [0, 2^n) and [2^n, 2^(n + 1)).
  static bool refined(const typename Scalars<D>::Brick& intervals) {
    for (std::size_t v = 0; v < Scalars<D>::kVertices; ++v) {
      if (intervals.knows(v) && intervals.middle(v) >> intervals.width(v) > 3) return true;
    }
    return false;
  }

  using Gains = std::array<int64_t, kMostHalf + 1>;  // in 2^-kGainBits, by log2 of half an interval

  /// Of a truth that lies anywhere in its interval, variance half²/3, and a fit that is off by a
  /// variance of its own, the best estimate is so far from the middle towards the fit. The offsets'
  /// mean square is the sum of both variances; a tenth of the first is always left.
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
    int32_t log2Half,
        offset;  // of the interval, and of the fit from its middle; as the window is scaled
  };

  ScalarWindow<D> window_;
  FitWindow<D> fits_;
  std::array<Move, Scalars<D>::kVertices> moves_;  // of the brick in work
  std::size_t count_ = 0;
};

}  // namespace isostar
