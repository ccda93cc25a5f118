// The further passes of the final geometry (§5.3): intervals are halved while they move the surface.
#pragma once

#include <bit>

#include "exchange.h"
#include "interpolation.h"
#include "tube.h"

namespace isostar {

/// Halves the intervals of those vertices that still move a vertex of the surface by more than the pass allows, as both
/// sides can see.
template <int D>
class HalvingCoder {
 public:
  HalvingCoder() : chances_(kContexts) {}

  /// How far a crossing may move along an edge of the RBMT, in 1/65536 of it, by the set of axes that the edge runs
  /// along. The last, the cell's diagonal, is 0 where diagonals do not count.
  using Allowed = std::array<uint32_t, (1u << D)>;

  /// What a pass does: at most `most` halvings of an interval; a selective one first tells of each brick whether it
  /// takes part.
  struct Pass {
    Members members = Members::AxisEnds;
    Allowed allowed{};
    int most = 1;
    bool selective = false;
  };

  template <class Exchange>
  void tell(Exchange& ask, const Signs<D>& signs, Scalars<D>& scalars, const Pass& pass, const std::vector<uint8_t>& active) {
    for (std::size_t place = 0; place < active.size() && !ask.spent(); ++place) {
      if (active[place] == 0 || !scalars.has(place)) continue;
      if (pass.selective && !selectModel_.bit(ask.coder(), ask.selected(place))) continue;
      gradient_ = scalars.gradient(place);
      scale_ = std::max(0, gradient_ / 4 - 17);
      window_.load(scalars, signs.table(), signs.table().brick(place));
      auto& brick = scalars.writable(place);
      brick.members[static_cast<std::size_t>(pass.members)].forEach([&](std::size_t r, int x) {
        if (!ask.spent()) vertex(ask, brick, place, r, x, pass);
      });
    }
  }

 private:
  /// As Scalars keep it, without the sign.
  struct Interval {
    uint32_t middle;
    [[nodiscard]] int width() const { return std::countr_zero(middle); }
  };
  /// The far end of a crossed edge of the RBMT.
  struct FarEnd {
    uint64_t size;  // of its scalar, half quanta, scaled
    uint64_t allowed;
  };
  static constexpr int kRatios = 32;
  static constexpr std::size_t kContexts = 8 * 4 * kRatios;
  static constexpr uint32_t kMostSize = 1u << 22;

  template <class Exchange>
  void vertex(Exchange& ask, typename Scalars<D>::Brick& brick, std::size_t place, std::size_t r, int x, const Pass& pass) {
    const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
    if (!brick.knows(v)) return;
    const bool positive = brick.value[v] > 0;
    Interval interval{brick.middle(v)};
    findFarEnds(r, x, positive, pass.allowed);
    if (!moves(interval, pass.selective)) return;
    const auto guess = Interpolation<D>::of(window_, r, x, positive);
    const uint32_t truth = ask.magnitude(place, r, x);
    for (int told = 0; told < pass.most && moves(interval, pass.selective); ++told) halve(ask, interval, guess, truth);
    const auto middle = static_cast<int32_t>(interval.middle);
    window_.value[window_.index(r, x)] = brick.value[v] = positive ? middle : -middle;
  }

  /// Of a vertex's crossed edges, where their scalars are known.
  void findFarEnds(std::size_t r, int x, bool mine, const Allowed& allowed) {
    const int32_t* here = &window_.value[ScalarWindow<D>::index(r, x)];
    farEndCount_ = 0;
    for (int a = 0; a < D; ++a) {
      for (int side = -1; side <= 1; side += 2) addFarEnd(here[side * ScalarWindow<D>::stride(a)], mine, allowed[std::size_t{1} << a]);
    }
    if (allowed.back() != 0) findDiagonals(here, mine, Tube<D>::parity(r, x), allowed);
  }

  void findDiagonals(const int32_t* here, bool mine, unsigned parity, const Allowed& allowed) {
    Coordinates<D> d;
    d.fill(-1);
    for (std::size_t n = 0; n < power(3, D); ++n) {
      unsigned axes = 0;
      int offset = 0;
      for (int a = 0; a < D; ++a) {
        axes |= d[a] != 0 ? 1u << a : 0u;
        offset += d[a] * ScalarWindow<D>::stride(a);
      }
      // Ends are even on all axes of the diagonal, or odd on all.
      if (!std::has_single_bit(axes) && axes != 0 && ((parity & axes) == 0 || (parity & axes) == axes)) addFarEnd(here[offset], mine, allowed[axes]);
      for (int a = 0; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
  }

  /// Written always, counted where it is one: a branch less that nobody could predict.
  void addFarEnd(int32_t value, bool mine, uint32_t allowed) {
    farEnds_[farEndCount_] = {scaled(static_cast<uint32_t>(value < 0 ? -int64_t{value} : value)), allowed};
    farEndCount_ += value != Scalars<D>::kUnknown && (value > 0) != mine ? 1 : 0;
  }

  /// To 22 bits for sizes up to 16 gradients, so that products fit.
  [[nodiscard]] uint64_t scaled(uint32_t size) const { return std::clamp<uint32_t>(size >> scale_, 1, kMostSize); }

  /// May the interval move a crossing on one of the edges found by more than allowed? Half of it times
  /// |b| / (|a| + |b|)² is how far the crossing moves, to first order; towards a small end of the interval it is more,
  /// and a selective pass counts that.
  [[nodiscard]] bool moves(const Interval& interval, bool selective) const {
    const int width = interval.width();
    if (width == 0) return false;
    const uint64_t middle = scaled(interval.middle), nearer = selective ? (uint64_t{1} << width) >> scale_ : 0;
    const int shift = std::min(width + 17 - scale_, 41);  // an interval far wider than the gradient moves anything
    for (std::size_t i = 0; i < farEndCount_; ++i) {
      const uint64_t total = farEnds_[i].size + middle;
      if (farEnds_[i].size << shift > farEnds_[i].allowed * total * (total - nearer)) return true;
    }
    return false;
  }

  template <class Exchange>
  void halve(Exchange& ask, Interval& interval, const Interpolation<D>& guess, uint32_t truth) {
    const int width = interval.width() - 1;
    // Where the guess lies in the interval, in sixteenths; it may lie outside.
    const int64_t offset = ((guess.magnitude - int64_t{interval.middle}) * (kRatios / 8)) >> width;
    const auto ratio = static_cast<std::size_t>(std::clamp<int64_t>(offset + kRatios / 2, 0, kRatios - 1));
    const auto fineness = static_cast<std::size_t>(std::clamp(gradient_ / 4 - width, 0, 7));
    Chance& chance = chances_[(fineness * 4 + static_cast<std::size_t>(guess.confidence)) * kRatios + ratio];
    const bool upper = chance.bit(ask.coder(), 2 * uint64_t{truth} >= interval.middle);
    const uint32_t half = uint32_t{1} << width;
    interval.middle += upper ? half : -half;
  }

  ScalarWindow<D> window_;
  int gradient_ = 0, scale_ = 0;  // of the brick in work
  std::array<FarEnd, power(3, D)> farEnds_;  // of the vertex in work
  std::size_t farEndCount_ = 0;
  Chance selectModel_;
  std::vector<Chance> chances_;
};

}  // namespace isostar
