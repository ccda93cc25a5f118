// Final geometry (§5.3): scalars at the vertices of the tube, in passes of growing precision.
#pragma once

#include <bit>

#include "exchange.h"
#include "octave.h"
#include "interpolation.h"
#include "prediction.h"
#include "tube.h"

namespace isostar {

/// Tells |scalar - isovalue| at the tube's vertices. The first pass tells the octave that a magnitude lies in (below a
/// floor relative to the brick's gradient: that it lies there); each further pass halves the intervals of those
/// vertices that still move a vertex of the surface by more than the pass allows. A crossing lies at |a| / (|a| + |b|),
/// so that such steps are even in distance whatever the gradient.
template <int D>
class GeometryCoder {
 public:
  GeometryCoder()
      : shape_(kShapeContexts), guess_(kGuessContexts), beside_(kBesideContexts), both_(kBothContexts), refine_(kRefineContexts) {
    weights_.fill(Mixer<kInputs>::fresh());
  }

  /// The first pass: a brick's gradient, then the octave of each magnitude. Intervals [0, 2^floor) at the least,
  /// floor being `depth` octaves below the brick's gradient.
  template <class Exchange>
  void tellOctaves(Exchange& ask, const Signs<D>& signs, Scalars<D>& scalars, Members members, int depth, const std::vector<uint8_t>& active) {
    for (std::size_t place = 0; place < active.size() && !ask.spent(scalars.memory()); ++place) {
      if (active[place] == 0) continue;
      const Tube<D>& tube = tubes_[static_cast<std::size_t>(members)].at(signs, place, members);
      if (tube.empty()) continue;
      if (!scalars.has(place)) tellGradient(ask, scalars, place);
      if (ask.spent()) return;  // what was read of the gradient may be noise
      enter(tube, scalars, place);
      shapes_.load(tube.window());
      auto& brick = scalars.writable(place);
      const int floor = std::clamp(gradient_ / 4 - depth, 0, kMostWidth);
      // Positive vertices first: the others then know the far ends of their crossing edges.
      for (const bool positive : {true, false}) tube.forEach(positive, [&](int row, std::size_t r, int x) {
        if (ask.spent()) return;
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        const int octave = tellOctave(ask, row, r, x, floor, ask.magnitude(place, r, x));
        const uint32_t low = octave == 0 ? 0 : uint32_t{1} << (floor + octave - 1);
        brick.set(v, positive, low, octave == 0 ? floor : floor + octave - 1);
        window_.value[window_.index(r, x)] = brick.value[v];
      });
    }
  }

  /// How far a crossing may move along an edge of the RBMT, in 1/65536 of it, by the set of axes that the edge runs
  /// along. The last, the cell's diagonal, is 0 where diagonals do not count.
  using Allowed = std::array<uint32_t, (1u << D)>;

  /// A further pass: halves intervals, at most `most` times each, while they move a crossing by more than allowed.
  /// A selective pass first tells of each brick whether it takes part.
  template <class Exchange>
  void refine(Exchange& ask, const Signs<D>& signs, Scalars<D>& scalars, Members members, const Allowed& allowed, int most, bool selective,
              const std::vector<uint8_t>& active) {
    selective_ = selective;
    for (std::size_t place = 0; place < active.size() && !ask.spent(scalars.memory()); ++place) {
      if (active[place] == 0 || !scalars.has(place)) continue;
      if (selective && !selectModel_.bit(ask.coder(), ask.selected(place))) continue;
      const Tube<D>& tube = tubes_[static_cast<std::size_t>(members)].at(signs, place, members);
      if (tube.empty()) continue;
      enter(tube, scalars, place);
      auto& brick = scalars.writable(place);
      tube.forEach([&](int row, std::size_t r, int x) {
        const std::size_t v = r * kBrickSide + static_cast<std::size_t>(x);
        if (!brick.knows(v) || ask.spent()) return;
        const bool positive = tube.positive(row, x);
        const auto guess = Interpolation<D>::of(window_, r, x, positive, steps_.shift());
        findCrossed(row, x, r, allowed);
        for (int told = 0; told < most && brick.width[v] > 0 && moves(brick.middle(v), brick.width[v]); ++told) {
          halve(ask, brick, v, guess, positive, ask.magnitude(place, r, x));
          window_.value[window_.index(r, x)] = brick.value[v];
        }
      });
    }
  }

 private:
  static constexpr int kMostOctaves = 8;  // told apart as contexts
  static constexpr int kRatios = 32;
  static constexpr int kInputs = 4;
  static constexpr std::size_t kShapeContexts = kMostOctaves * 8 * 64;
  static constexpr std::size_t kGuessContexts = kMostOctaves * 4 * kRatios * 4;
  static constexpr std::size_t kBesideContexts = kMostOctaves * 8 * 16 * 16;
  static constexpr std::size_t kBothContexts = kMostOctaves * kRatios * 16 * 8;
  static constexpr std::size_t kRefineContexts = 8 * 4 * kRatios;

  /// The gradient by which a brick's floor and contexts are scaled: as a difference to the last one told.
  template <class Exchange>
  void tellGradient(Exchange& ask, Scalars<D>& scalars, std::size_t place) {
    const int truth = ask.gradient(place) - lastGradient_;
    auto& coder = ask.coder();
    int difference = 0;
    if (gradientModel_[0].bit(coder, truth != 0)) {
      const bool down = gradientModel_[1].bit(coder, truth < 0);
      int size = 1;
      while (size < 128 && gradientModel_[static_cast<std::size_t>(std::min(size + 1, 15))].bit(coder, (down ? -truth : truth) > size)) ++size;
      difference = down ? -size : size;
    }
    lastGradient_ = std::clamp(lastGradient_ + difference, 0, kMostGradient);
    scalars.setGradient(place, lastGradient_);
  }

  void enter(const Tube<D>& tube, const Scalars<D>& scalars, std::size_t place) {
    tube_ = &tube;
    gradient_ = scalars.gradient(place);
    steps_ = Steps(gradient_);
    window_.load(scalars, tube.table(), tube.at());
  }

  /// 8 log2 of a magnitude, roughly; 0 for nothing.
  static int eighths(uint64_t magnitude) {
    if (magnitude == 0) return 0;
    const int top = 63 - std::countl_zero(magnitude);
    return top * 8 + static_cast<int>((top >= 3 ? magnitude >> (top - 3) : magnitude << (3 - top)) & 7) + 1;
  }

  template <class Exchange>
  int tellOctave(Exchange& ask, int row, std::size_t r, int x, int floor, uint32_t truth) {
    const auto g = Prediction<D>::of(shapes_, window_, tube_->positive(row, x), r, x, steps_);
    const int guessed = eighths(static_cast<uint64_t>(g.magnitude) / 2);
    const int expected = std::clamp((guessed - 1) / 8 + 1 - floor, 0, kMostWidth - floor);
    const int octave = std::max(0, 32 - std::countl_zero(truth) - floor);
    const Beside beside = neighbours(row, r, x);
    auto above = [&](int k) {
      const auto at = static_cast<std::size_t>(std::min(k, kMostOctaves - 1));
      const auto ratio = static_cast<std::size_t>(std::clamp(guessed - 8 * (floor + k) + kRatios / 2, 0, kRatios - 1));
      const auto confidence = static_cast<std::size_t>(g.confidence), shape = static_cast<std::size_t>(g.shape);
      const std::array<Chance*, kInputs> contexts{
          &shape_[(at * 8 + beside.crossings) * 64 + shape],
          &guess_[((at * 4 + confidence) * kRatios + ratio) * 4 + beside.other / 4],
          &beside_[((at * 8 + beside.crossings) * 16 + beside.other) * 16 + beside.same],
          &both_[((at * kRatios + ratio) * 16 + shape / 4) * 8 + beside.crossings]};
      const std::size_t trust = at * 4 + (beside.other != 0 ? 1 : 0) + (beside.same != 0 ? 2 : 0);
      return Mixer<kInputs>::template bit<127, 10>(ask.coder(), octave > k, contexts, weights_[trust]);
    };
    int k = expected;
    if (k < kMostWidth - floor && above(k)) {
      do ++k;
      while (k < kMostWidth - floor && above(k));
    } else {
      while (k > 0 && !above(k - 1)) --k;
    }
    return k;
  }

  /// Crossing axis edges at a vertex, and the sizes of the scalars next to it, 0 where unknown.
  struct Beside {
    std::size_t crossings = 0, other = 0, same = 0;
  };
  [[nodiscard]] Beside neighbours(int row, std::size_t r, int x) const {
    Beside beside;
    int64_t other = 0, same = 0;
    int32_t others = 0, sames = 0;
    const int32_t* here = &window_.value[ScalarWindow<D>::index(r, x)];
    const bool mine = tube_->positive(row, x);
    for (int a = 0; a < D; ++a) {
      for (int side = -1; side <= 1; side += 2) {
        const bool theirs = a == 0 ? tube_->positive(row, x + side) : tube_->positive(row + side * Window<D>::rowStride(a), x);
        const int32_t value = here[side * ScalarWindow<D>::stride(a)];
        // Masks instead of branches, which nobody could predict.
        const int32_t known = value == Scalars<D>::kUnknown ? 0 : -1, crossing = theirs != mine ? -1 : 0;
        const int32_t size = (value < 0 ? -(value & known) : value) & known;
        beside.crossings -= static_cast<std::size_t>(static_cast<std::ptrdiff_t>(crossing));
        other += size & crossing;
        others -= known & crossing;
        same += size & ~crossing;
        sames -= known & ~crossing;
      }
    }
    if constexpr (D > 3) beside.crossings = std::min<std::size_t>(beside.crossings, 7);
    if (others != 0) beside.other = relative(other, others);
    if (sames != 0) beside.same = relative(same, sames);
    return beside;
  }
  /// A mean size relative to the gradient, in half octaves, 1 … 15.
  [[nodiscard]] std::size_t relative(int64_t sum, int count) const {
    const int size = eighths(static_cast<uint64_t>(sum * reciprocal(2 * count) >> 16)) / 4 - gradient_ / 2;
    return static_cast<std::size_t>(std::clamp(size + 11, 1, 15));
  }

  /// The far ends of a vertex's crossed edges whose scalars are known.
  void findCrossed(int row, int x, std::size_t r, const Allowed& allowed) {
    const int32_t* here = &window_.value[ScalarWindow<D>::index(r, x)];
    const bool mine = tube_->positive(row, x);
    crossedCount_ = 0;
    for (int a = 0; a < D; ++a) {
      for (int side = -1; side <= 1; side += 2) addCrossed(here[side * ScalarWindow<D>::stride(a)], mine, allowed[std::size_t{1} << a]);
    }
    if (allowed.back() != 0) addDiagonals(here, mine, Tube<D>::parity(r, x), allowed);
  }

  void addDiagonals(const int32_t* here, bool mine, unsigned parity, const Allowed& allowed) {
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
      if (!std::has_single_bit(axes) && axes != 0 && ((parity & axes) == 0 || (parity & axes) == axes)) addCrossed(here[offset], mine, allowed[axes]);
      for (int a = 0; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
  }

  /// Written always, counted where it is one: a branch less that nobody could predict.
  void addCrossed(int32_t value, bool mine, uint32_t allowed) {
    crossed_[crossedCount_] = {static_cast<uint32_t>(value < 0 ? -int64_t{value} : value), allowed};
    crossedCount_ += value != Scalars<D>::kUnknown && (value > 0) != mine ? 1 : 0;
  }

  /// May the interval move a crossing on one of the edges found by more than allowed?
  [[nodiscard]] bool moves(uint32_t middle, int width) const {
    for (std::size_t i = 0; i < crossedCount_; ++i) {
      if (exceeds(crossed_[i].size, middle, width, crossed_[i].allowed)) return true;
    }
    return false;
  }

  /// Half the interval times |b| / (|a| + |b|)² is how far the crossing moves, to first order; towards a small end of
  /// the interval it is more, and a selective pass counts that.
  [[nodiscard]] bool exceeds(uint64_t other, uint32_t middle, int width, uint32_t allowed) const {
    uint64_t total = other + middle, least = selective_ ? total - (uint64_t{1} << width) : total, size = uint64_t{2} << width;
    const int excess = std::max(0, 44 - std::countl_zero(total));
    other = std::max<uint64_t>(1, other >> excess);
    least = std::max<uint64_t>(1, least >> excess);
    total >>= excess;
    size >>= excess;
    return (size * other) << 16 > allowed * total * least;
  }

  template <class Exchange>
  void halve(Exchange& ask, typename Scalars<D>::Brick& brick, std::size_t v, const Interpolation<D>& g, bool positive, uint32_t truth) {
    const int width = brick.width[v] - 1;
    const uint32_t low = brick.low(v), middle = low + (uint32_t{1} << width);
    // Where the guess lies in the interval, in sixteenths; it may lie outside.
    const int64_t offset = ((g.magnitude - 2 * int64_t{middle}) * (kRatios / 8)) >> width;
    const auto ratio = static_cast<std::size_t>(std::clamp<int64_t>(offset + kRatios / 2, 0, kRatios - 1));
    const auto fineness = static_cast<std::size_t>(std::clamp(gradient_ / 4 - width, 0, 7));
    Chance& chance = refine_[(fineness * 4 + static_cast<std::size_t>(g.confidence)) * kRatios + ratio];
    const bool upper = chance.bit(ask.coder(), truth >= middle);
    brick.set(v, positive, upper ? middle : low, width);
  }

  static constexpr int kMostWidth = 29;
  static constexpr int kMostGradient = 4 * 31;

  std::array<Tubes<D>, 2> tubes_;  // by Members
  const Tube<D>* tube_ = nullptr;
  struct Crossed {
    uint32_t size;  // of the scalar at the far end, half quanta
    uint32_t allowed;
  };
  std::array<Crossed, power(3, D)> crossed_;
  std::size_t crossedCount_ = 0;
  ScalarWindow<D> window_;
  ShapeEstimate<D> shapes_;
  int gradient_ = 0;
  Steps steps_;
  int lastGradient_ = 0;
  bool selective_ = false;
  std::array<Chance, 16> gradientModel_;
  Chance selectModel_;
  std::vector<Chance> shape_, guess_, beside_, both_, refine_;
  std::array<Mixer<kInputs>::Weights, kMostOctaves * 4> weights_;
};

}  // namespace isostar
