// An adaptive mesh of the RBMT and the field on it (§4.3, §5.1, §5.2): octave by octave, for both directions.
#pragma once

#include <algorithm>
#include <optional>

#include "base_coder.h"
#include "completion.h"
#include "filling_coder.h"
#include "halving_coder.h"
#include "isostar/isostar.h"
#include "octave.h"
#include "octaves_coder.h"
#include "refinement_coder.h"
#include "seldom.h"

namespace isostar {

/// What is known of an octave's vertices once those that are not in the mesh have the values of the simplices they lie in.
template <int D>
struct AdaptiveOctave {
  Signs<D> signs;
  Scalars<D> scalars;  // told, taken over from the coarser octave, or interpolated
  std::vector<uint8_t> active;

  /// Bytes in use, while one more brick is made.
  [[nodiscard]] uint64_t memory() const { return signs.memory() + scalars.memory() + active.size(); }
};

/// An adaptive mesh is one of whole octaves with absent vertices: a crossing cell that is kept whole has none of the
/// vertices that would split it, nor have its neighbours those that need them. An absent vertex lies on the refinement
/// edge that it would split, halfway, and so does its scalar: the field is the piecewise linear one of the leaves, whatever
/// octave it is looked at, and no polygonizer can find a crack.
template <int D>
class AdaptiveMesh {
 public:
  explicit AdaptiveMesh(const Lattice<D>& base) : signs_(1, Signs<D>(base)), absent_(1, Signs<D>(base)), coders_(std::in_place) {}

  /// Of an octave without absent vertices and the next one, to show what is known of it: no more of it can be told.
  AdaptiveMesh(Signs<D> coarse, Signs<D> fine, Signs<D> absent) : absent_(1, Signs<D>(coarse.lattice())) {
    signs_.push_back(std::move(coarse));
    signs_.push_back(std::move(fine));
    absent_.push_back(std::move(absent));
  }

  Displacements<D> coarserDisplacements;  // of the octave before the last one, where no scalars are known
  Kernel kernel = Kernel::Middle, coarserKernel = Kernel::Middle;  // place the last octave's surface where no scalars are known, and others'

  [[nodiscard]] int level() const { return static_cast<int>(signs_.size()) - 1; }
  /// Octaves whose scalars have been told.
  [[nodiscard]] int told() const { return static_cast<int>(octaves_.size()); }
  [[nodiscard]] const Lattice<D>& lattice() const { return signs_.back().lattice(); }
  [[nodiscard]] const AdaptiveOctave<D>& octave(int level) const { return octaves_[static_cast<std::size_t>(level)]; }
  [[nodiscard]] const Signs<D>& absent(int level) const { return absent_[static_cast<std::size_t>(level)]; }
  /// Bytes in use beside the models, while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = coders_ ? coders_->refinement.memory() : 0;
    sum += coarserDisplacements.memory();
    for (const auto& s : signs_) sum += s.memory();
    for (const auto& s : absent_) sum += s.memory();
    for (const auto& o : octaves_) sum += o.memory();
    return sum;
  }
  /// What it takes at most, on top of that, to begin the next octave's mesh.
  [[nodiscard]] uint64_t memoryToRefine() const {
    const BrickTable<D> finer(lattice().finer());
    const uint64_t places = finer.total();
    return 2 * places + Signs<D>::memoryToFill(places, mostRefinedBricks(signs_.back(), finer)) + Signs<D>::memoryToFill(places, uint64_t{absent_.back().brickCount()} << D);
  }
  /// The same to fill an octave: vertices that were absent may need bricks of their own, on finer octaves, too.
  [[nodiscard]] uint64_t memoryToFill(int level) const {
    uint64_t sum = 0;
    for (auto o = static_cast<std::size_t>(level); o < signs_.size(); ++o) {
      sum += Signs<D>::memoryToFill(signs_[o].table().total(), uint64_t{signs_[o].brickCount()} + absent_[o].brickCount());
    }
    return sum;
  }
  /// The same for the next octave's scalars.
  [[nodiscard]] uint64_t memoryToTell() const { return told() > level() ? 0 : memoryForNext(octaves_.empty() ? nullptr : &octaves_.back(), told()); }

  template <class Exchange>
  void base(Exchange& ask) {
    BaseCoder<D>().tell(ask, signs_.front());
  }

  /// The next octave: which crossing cells stay whole, and the signs of the new vertices of the others.
  template <class Exchange>
  ISOSTAR_SELDOM void refine(Exchange& ask) {
    Signs<D> fine = refined(signs_.back()), absent = inherited(absent_.back());
    coders_->refinement.tell(ask, fine, &absent);
    if (ask.spent()) return;  // the octave stays as it was
    signs_.push_back(std::move(fine));
    absent_.push_back(std::move(absent));
  }

  /// The base and all octaves at once; what shows is only the whole.
  template <class Exchange>
  ISOSTAR_SELDOM void tellAll(Exchange& ask, int octaves) {
    ask.enter(0);
    base(ask);
    for (int level = 1; level <= octaves; ++level) {
      ask.hold(memory());
      if (ask.spent(memoryToRefine())) return;
      ask.enter(level);
      refine(ask);
    }
  }

  /// The absent vertices of an octave, those of coarser ones being there: the reverse of the welds that made them absent.
  template <class Exchange>
  ISOSTAR_SELDOM void fill(Exchange& ask, int level) {
    auto& signs = signs_[static_cast<std::size_t>(level)];
    auto& absent = absent_[static_cast<std::size_t>(level)];
    forEachMember(absent, [&](const Coordinates<D>& v) {
      auto corner = v;
      for (int a = 0; a < D; ++a) corner[a] -= signs.lattice().fresh(a, v[a]) ? 1 : 0;
      signs.set(v, signs.at(corner));
    });
    ask.hold(memory());
    for (int dimension = D; dimension >= 1; --dimension) coders_->filling.tell(ask, signs, dimension, absent);
    if (ask.spent()) return;
    absent = Signs<D>(signs.lattice());
    for (int finer = level + 1; finer <= this->level(); ++finer) takeOverFilled(finer);
  }

  /// The signs of the finest octave; the mesh is of no use any more.
  [[nodiscard]] Signs<D> takeSigns() { return std::move(signs_.back()); }

  /// Scalars of an octave: of the vertices of its leaves that coarser ones have not told. On the finest, `cubes` needs no
  /// ends of diagonals.
  template <class Exchange>
  void tellOctaves(Exchange& ask, int depth, Polygonizer polygonizer) {
    octaves_.push_back(next(octaves_.empty() ? nullptr : &octaves_.back(), told()));
    auto& octave = octaves_.back();
    const int level = told() - 1;
    coders_->octaves.tell(ask, octave.signs, octave.scalars, Members::AxisEnds, depth, octave.active, [&](Tube<D>& tube) {
      if (level < this->level() || polygonizer == Polygonizer::Tetrahedra) tube.addDiagonalEnds(octave.signs);
      tube.keepOnly([&](std::size_t r, int x) { return belongsToLeaf(tube.at(), r, x, level) && !knows(octave.scalars, tube.table(), tube.at(), r, x); });
    });
  }
  template <class Exchange>
  void tellHalvings(Exchange& ask, const typename HalvingCoder<D>::Pass& pass) {
    auto& octave = octaves_.back();
    coders_->halvings.tell(ask, octave.signs, octave.scalars, pass, octave.active);
  }

  /// The octave as it is known, with estimates where nothing has been told yet; nothing if that takes more bytes than given.
  [[nodiscard]] ISOSTAR_SELDOM std::optional<AdaptiveOctave<D>> shown(int level, uint64_t memory = UINT64_MAX) const {
    AdaptiveOctave<D> octave;
    for (int o = std::max(told() - 1, 0); o <= level; ++o) {
      const uint64_t made = o < told() ? octaves_[static_cast<std::size_t>(o)].memory() : memoryForNext(o == 0 ? nullptr : &octave, o);
      if (octave.memory() + made > memory) return std::nullopt;
      if (o < told()) octave = octaves_[static_cast<std::size_t>(o)];
      else octave = next(o == 0 ? nullptr : &octave, o);
      // Those known are copied while the others are estimated.
      const auto bricks = octave.scalars.brickCount() + static_cast<std::size_t>(std::count(octave.active.begin(), octave.active.end(), 1));
      if (octave.memory() + 2 * Scalars<D>::memoryOf(octave.active.size(), bricks) > memory) return std::nullopt;
      estimate(o, told() == 0 ? level - o : 0, octave);
    }
    return octave;
  }

 private:
  static bool knows(const Scalars<D>& scalars, const BrickTable<D>& table, const Coordinates<D>& brick, std::size_t r, int x) {
    return scalars.at(table.place(brick)).knows(r * kBrickSide + static_cast<std::size_t>(x));
  }
  static int32_t valueAt(const Scalars<D>& scalars, const BrickTable<D>& table, const Coordinates<D>& v) {
    return scalars.at(table.placeOf(v)).value[numberOf<D>(v)];
  }
  /// The finer octave's plane that coincides.
  static int32_t child(const Lattice<D>& coarse, const Lattice<D>& fine, int axis, int32_t plane) {
    return plane == coarse.last[axis] ? fine.last[axis] : 2 * plane;
  }
  /// The absent vertices of a coarser octave on the next one's lattice.
  static Signs<D> inherited(const Signs<D>& coarse) {
    Signs<D> fine(coarse.lattice().finer());
    forEachMember(coarse, [&](const Coordinates<D>& v) {
      Coordinates<D> same;
      for (int a = 0; a < D; ++a) same[a] = child(coarse.lattice(), fine.lattice(), a, v[a]);
      fine.set(same, true);
    });
    return fine;
  }

  /// Where a vertex of an octave is on the coarser one; nothing if it is fresh.
  static std::optional<Coordinates<D>> onCoarser(const Lattice<D>& lattice, const Coordinates<D>& v) {
    Coordinates<D> parent;
    for (int a = 0; a < D; ++a) {
      if (lattice.fresh(a, v[a])) return std::nullopt;
      parent[a] = lattice.parent(a, v[a]);
    }
    return parent;
  }

  /// Vertices that are no longer absent on the coarser octave are there, too.
  ISOSTAR_SELDOM void takeOverFilled(int level) {
    auto& signs = signs_[static_cast<std::size_t>(level)];
    auto& absent = absent_[static_cast<std::size_t>(level)];
    const auto& coarser = signs_[static_cast<std::size_t>(level) - 1];
    forEachMember(absent, [&](const Coordinates<D>& v) {
      const auto parent = onCoarser(signs.lattice(), v);
      if (!parent || this->absent(level - 1).at(*parent)) return;
      signs.set(v, coarser.at(*parent));
      absent.set(v, false);
    });
  }

  /// Has the mesh the vertex, and is it one of a simplex that is not split further?
  [[nodiscard]] bool belongsToLeaf(const Coordinates<D>& brick, std::size_t r, int x, int level) const {
    const auto v = vertexOf<D>(brick, r * kBrickSide + static_cast<std::size_t>(x));
    if (absent(level).at(v)) return false;
    if (level == this->level()) return true;
    const auto& finer = absent(level + 1);
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      const int32_t middle = child(absent(level).lattice(), finer.lattice(), a, v[a]);
      low[a] = std::max(middle - 1, 0);
      high[a] = std::min(middle + 1, finer.lattice().last[a]);
    }
    for (auto w = low;;) {
      if (finer.at(w)) return true;
      int a = 0;
      for (; a < D && ++w[a] > high[a]; ++a) w[a] = low[a];
      if (a == D) return false;
    }
  }

  /// Bytes that next() takes at most.
  [[nodiscard]] uint64_t memoryForNext(const AdaptiveOctave<D>* coarser, int level) const {
    const auto& signs = signs_[static_cast<std::size_t>(level)];
    const uint64_t places = signs.table().total(), absentBricks = absent(level).brickCount();
    const uint64_t taken = coarser == nullptr ? 0 : (uint64_t{coarser->scalars.brickCount()} << D) + absentBricks;
    return places + Signs<D>::memoryToFill(places, signs.brickCount() + absentBricks) + Scalars<D>::memoryOf(places, std::min(places, taken));
  }

  /// An octave before its own scalars are told: from the coarser one, if there is one.
  [[nodiscard]] ISOSTAR_SELDOM AdaptiveOctave<D> next(const AdaptiveOctave<D>* coarser, int level) const {
    AdaptiveOctave<D> octave{signs_[static_cast<std::size_t>(level)], {}, {}};
    octave.scalars = Scalars<D>(octave.signs.table().total());
    if (coarser != nullptr) {
      takeOver(*coarser, octave);
      interpolate(absent(level), *coarser, octave);
    }
    octave.active = activeBricks(octave.signs);
    return octave;
  }

  /// Gives the vertices of an octave's leaves values, as many times larger as its steps are longer: those of other vertices
  /// are better estimated on finer octaves.
  ISOSTAR_SELDOM void estimate(int level, int finer, AdaptiveOctave<D>& octave) const {
    const Scalars<D> before = octave.scalars;
    const Hints<D> hints = level == this->level() ? Hints<D>{kernel} : Hints<D>{coarserKernel, level + 1 == this->level() ? &coarserDisplacements : nullptr};
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) estimateMissing(octave.signs, octave.active, members, finer, octave.scalars, hints);
    if (level == this->level()) return;
    const auto& table = octave.signs.table();
    for (std::size_t place = 0; place < table.total(); ++place) {
      if (!octave.scalars.has(place)) continue;
      auto& brick = octave.scalars.writable(place);
      for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
        if (!brick.knows(i) || before.at(place).knows(i) || belongsToLeaf(table.brick(place), i / kBrickSide, static_cast<int>(i % kBrickSide), level)) continue;
        brick.value[i] = Scalars<D>::kUnknown;
      }
    }
  }

  static void takeOver(const AdaptiveOctave<D>& coarser, AdaptiveOctave<D>& octave) {
    const auto& from = coarser.signs;
    for (std::size_t place = 0; place < from.table().total(); ++place) {
      if (!coarser.scalars.has(place)) continue;
      const auto& brick = coarser.scalars.at(place);
      for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
        if (!brick.knows(i)) continue;
        auto v = vertexOf<D>(from.table().brick(place), i);
        for (int a = 0; a < D; ++a) v[a] = child(from.lattice(), octave.signs.lattice(), a, v[a]);
        octave.scalars.writable(octave.signs.table().placeOf(v)).value[numberOf<D>(v)] = brick.value[i];
      }
    }
  }

  /// Absent vertices: those of the coarser octave as they are there, the others halfway between the ends of their
  /// refinement edge.
  static void interpolate(const Signs<D>& absent, const AdaptiveOctave<D>& coarser, AdaptiveOctave<D>& octave) {
    forEachMember(absent, [&](const Coordinates<D>& v) {
      if (const auto parent = onCoarser(octave.signs.lattice(), v)) octave.signs.set(v, coarser.signs.at(*parent));
    });
    forEachMember(absent, [&](const Coordinates<D>& v) { halfway(v, octave); });
  }

  static void halfway(const Coordinates<D>& v, AdaptiveOctave<D>& octave) {
    const auto& lattice = octave.signs.lattice();
    const auto& table = octave.signs.table();
    Coordinates<D> even = v, odd = v;
    for (int a = 0; a < D; ++a) {
      if (!lattice.fresh(a, v[a])) continue;
      const bool lowIsEven = lattice.parent(a, v[a]) % 2 == 0;
      (lowIsEven ? even : odd)[a] -= 1;
      (lowIsEven ? odd : even)[a] += 1;
    }
    if (even == odd) return;
    const int32_t from = valueAt(octave.scalars, table, even), to = valueAt(octave.scalars, table, odd);
    const bool known = from != Scalars<D>::kUnknown && to != Scalars<D>::kUnknown;
    if (!known) {
      octave.signs.set(v, octave.signs.at(even));
      return;
    }
    const auto mean = static_cast<int32_t>((int64_t{from} + to) / 2);
    const int32_t value = mean == 0 ? -1 : mean;
    octave.signs.set(v, value > 0);
    octave.scalars.writable(table.placeOf(v)).value[numberOf<D>(v)] = value;
  }

  std::vector<Signs<D>> signs_, absent_;  // by octave, as they were told
  std::vector<AdaptiveOctave<D>> octaves_;
  struct Coders {
    RefinementCoder<D> refinement;
    FillingCoder<D> filling;
    OctavesCoder<D> octaves;
    HalvingCoder<D> halvings;
  };
  std::optional<Coders> coders_;  // with models of some megabytes
};

}  // namespace isostar
