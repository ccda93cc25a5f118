// Where in their intervals scalars are shown as long as these are wide: where those around them put them, for display only.
#pragma once

#include "local_fit.h"
#include "octave.h"
#include "seldom.h"

namespace isostar {

/// Moves the told scalars of `shown`, which count 2^-finer half quanta, to what a fit says of each, within their intervals. Only in
/// bricks where most fits agree with what has been told: elsewhere the field is rough, and the middle is best.
template <int D>
class Smoothing {
 public:
  ISOSTAR_SELDOM static void apply(const BrickTable<D>& table, const Scalars<D>& told, int finer, Scalars<D>& shown) {
    Smoothing smoothing;
    for (std::size_t place = 0; place < told.places(); ++place) {
      if (told.has(place)) smoothing.brick(table, told, place, finer, shown);
    }
  }

 private:
  static constexpr int kAgree = 6;  // of ten fits
  /// Sixteenths of an interval's half: a fit counts up to there, and so much of what it says.
  static constexpr int64_t kInner = 13;

  void brick(const BrickTable<D>& table, const Scalars<D>& told, std::size_t place, int finer, Scalars<D>& shown) {
    window_.load(told, table, table.brick(place));
    fits_.load(window_, told.gradient(place));
    const auto& intervals = told.at(place);
    int agree = 0;
    count_ = 0;
    for (const auto& members : intervals.members) {
      members.forEach([&](std::size_t r, int x) {
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        if (!intervals.knows(v)) return;
        const auto fit = LocalFit<D>::of(fits_, r, x, intervals.value[v] > 0);
        if (fit.known == 0 || count_ == moves_.size()) return;
        const int shift = finer - fits_.up();
        const int64_t guess = shift >= 0 ? int64_t{fit.bent} << shift : int64_t{fit.bent} >> -shift;
        const int64_t middle = int64_t{intervals.middle(v)} << finer, half = (int64_t{1} << intervals.width(v)) << finer;
        agree += guess - middle < half && middle - guess < half ? 1 : 0;
        const int64_t within = std::clamp(guess - middle, -half * kInner / 16, half * kInner / 16) * kInner / 16;
        moves_[count_++] = {v, static_cast<int32_t>(std::max<int64_t>(middle + within, 1))};
      });
    }
    if (10 * agree < kAgree * static_cast<int>(count_)) return;
    auto& values = shown.writable(place).value;
    for (std::size_t i = 0; i < count_; ++i) values[moves_[i].vertex] = intervals.value[moves_[i].vertex] > 0 ? moves_[i].magnitude : -moves_[i].magnitude;
  }

  struct Move {
    std::size_t vertex;
    int32_t magnitude;
  };

  ScalarWindow<D> window_;
  FitWindow<D> fits_;
  std::array<Move, Scalars<D>::kVertices> moves_;  // of the brick in work
  std::size_t count_ = 0;
};

}  // namespace isostar
