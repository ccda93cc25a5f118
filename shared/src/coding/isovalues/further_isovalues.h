// Further isovalues on top of the first (§5.4): what both sides know of them.
#pragma once

#include <memory>
#include <tuple>

#include "coding/isovalues/further_magnitude_coder.h"
#include "coding/isovalues/further_sign_coder.h"
#include "grid/refined_signs.h"
#include "coding/geometry/exponent_coder.h"

namespace isostar {

/// An isovalue whose signs have been told, and how far its scalars are.
template <int D>
struct NearSurface {
  double isovalue = 0;
  int32_t level = 0;  // quanta above the first isovalue
  Signs<D> signs;
  std::vector<uint8_t> active;  // as of activeBricks(signs)
  Scalars<D> scalars;           // of all vertices with an interval, seen from the isovalue
  std::array<bool, 2> told{};   // by Members
};

template <int D>
class CloseBy {
 public:
  /// The first isovalue's surface, as far as it has been told.
  struct First {
    double isovalue;
    const Signs<D>& signs;
    const Scalars<D>& scalars;
  };

  /// A surface that has been told, and where its isovalue is.
  struct Neighbour {
    double isovalue;
    int32_t level;
    const Signs<D>* signs;
  };
  /// There is at least one: the first.
  struct Neighbours {
    std::optional<Neighbour> below, above;
    [[nodiscard]] const Neighbour& nearest(double isovalue) const {
      return !above || (below && isovalue - below->isovalue <= above->isovalue - isovalue) ? *below : *above;
    }
  };

  [[nodiscard]] const std::vector<NearSurface<D>>& surfaces() const { return surfaces_; }
  /// Of an isovalue; null where its signs have not been told.
  [[nodiscard]] const NearSurface<D>* find(double isovalue) const {
    for (const auto& s : surfaces_) {
      if (s.isovalue == isovalue) return &s;
    }
    return nullptr;
  }

  /// The signs of one more isovalue, `level` quanta above the first one; by `margin` levels and signs may disagree.
  template <class Exchange>
  [[gnu::noinline]] void signs(Exchange& ask, const First& first, double isovalue, int32_t level, int32_t margin) {
    if (surfaces_.empty()) takeOver(first);
    if (!coders_) coders_ = std::make_unique<Coders>();
    NearSurface<D> fresh;
    fresh.isovalue = isovalue;
    fresh.level = level;
    typename NearSignsCoder<D>::Task task;
    task.level = level;
    task.margin = margin;
    const Neighbours near = neighbours(first, isovalue);
    if (near.below) std::tie(task.below, task.levelBelow) = std::pair(near.below->signs, near.below->level);
    if (near.above) std::tie(task.above, task.levelAbove) = std::pair(near.above->signs, near.above->level);
    fresh.signs = *near.nearest(isovalue).signs;
    fresh.scalars = seenFrom(first, level);
    coders_->signs.tell(ask, task, intervals_, fresh.signs, fresh.scalars);
    if (ask.spent()) return;  // not all are known
    fresh.active = activeBricks(fresh.signs);
    surfaces_.push_back(std::move(fresh));
  }

  /// Octaves of what has no bounds yet.
  template <class Exchange>
  [[gnu::noinline]] void octaves(Exchange& ask, Members members, int depth) {
    NearSurface<D>& last = surfaces_.back();
    coders_->octaves.tell(ask, last.signs, last.scalars, members, depth, last.active);
    for (std::size_t place = 0; place < last.active.size(); ++place) {
      if (last.active[place] != 0 && last.scalars.has(place)) intervals_.add(place, last.scalars.at(place), last.level);
    }
    last.told[static_cast<std::size_t>(members)] = true;
  }

  template <class Exchange>
  void halvings(Exchange& ask, const typename NearHalvingCoder<D>::Pass& pass) {
    NearSurface<D>& last = surfaces_.back();
    coders_->halvings.tell(ask, last.signs, last.level, intervals_, last.scalars, pass, last.active);
  }

  /// The isovalues told on both sides of another.
  [[nodiscard]] Neighbours neighbours(const First& first, double isovalue) const {
    Neighbours near;
    const auto see = [&](const Neighbour& one) {
      if (one.isovalue <= isovalue && (!near.below || one.isovalue > near.below->isovalue)) near.below = one;
      if (one.isovalue > isovalue && (!near.above || one.isovalue < near.above->isovalue)) near.above = one;
    };
    see({first.isovalue, 0, &first.signs});
    for (const auto& s : surfaces_) see({s.isovalue, s.level, &s.signs});
    return near;
  }

  /// Middles of all intervals, with the gradients of the last isovalue told there.
  [[nodiscard]] Scalars<D> seenFrom(const First& first, int32_t level) const {
    if (intervals_.places() == 0) return first.scalars;  // no further one has begun
    Scalars<D> scalars(intervals_.places());
    int gradient = 0;
    for (std::size_t place = 0; place < intervals_.places(); ++place) {
      if (!intervals_.has(place)) continue;
      auto& brick = scalars.writable(place);
      const auto& known = intervals_.at(place);
      for (std::size_t v = 0; v < known.size(); ++v) {
        if (known[v].bounded()) brick.value[v] = known[v].value(level);
      }
      if (place < first.scalars.places() && first.scalars.has(place)) gradient = first.scalars.gradient(place);
      for (const auto& s : surfaces_) {
        if (s.scalars.has(place)) gradient = s.scalars.gradient(place);
      }
      scalars.setGradient(place, gradient);
    }
    return scalars;
  }

  /// Bytes that it takes at most to begin one more isovalue: intervals, scalars, signs as they are and as they become tidy.
  [[nodiscard]] uint64_t memoryToBegin(const First& first) const {
    const auto& table = first.signs.table();
    const uint64_t places = table.total();
    const bool none = surfaces_.empty();
    const uint64_t known = bricksSeen(first);
    uint64_t most = first.signs.brickCount();
    for (const auto& s : surfaces_) most = std::max<uint64_t>(most, s.signs.brickCount());
    return (none ? Intervals<D>::memoryOf(places, known) : 0) + Scalars<D>::memoryOf(places, known) + places +
           2 * Signs<D>::memoryToFill(places, most) + VertexFront<D>::memoryToBegin(table, 2 * most);
  }
  /// The same for scalars that are told of vertices without an interval.
  [[nodiscard]] uint64_t memoryToTell() const {
    const auto& active = surfaces_.back().active;
    uint64_t bricks = 0;
    for (std::size_t place = 0; place < active.size(); ++place) bricks += active[place] != 0 && !intervals_.has(place) ? 1 : 0;
    return Scalars<D>::memoryOf(0, bricks) + Intervals<D>::memoryOf(0, bricks);
  }
  /// Bytes in use beside the models, while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = memoryOfIntervals();
    for (const auto& s : surfaces_) sum += s.signs.memory() + s.scalars.memory() + s.active.size();
    return sum;
  }
  [[nodiscard]] uint64_t memoryOfIntervals() const { return intervals_.memory(); }
  /// In how many bricks seenFrom() knows something.
  [[nodiscard]] std::size_t bricksSeen(const First& first) const { return surfaces_.empty() ? first.scalars.brickCount() : intervals_.brickCount(); }

 private:
  struct Coders {
    NearSignsCoder<D> signs;
    OctavesCoder<D> octaves;
    NearHalvingCoder<D> halvings;
  };

  void takeOver(const First& first) {
    intervals_ = Intervals<D>(first.signs.table().total());
    for (std::size_t place = 0; place < first.scalars.places(); ++place) {
      if (first.scalars.has(place)) intervals_.add(place, first.scalars.at(place), 0);
    }
  }

  std::vector<NearSurface<D>> surfaces_;
  Intervals<D> intervals_;
  std::unique_ptr<Coders> coders_;  // most streams need none
};

}  // namespace isostar
