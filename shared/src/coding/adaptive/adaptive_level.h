// What is known of one level of an adaptive mesh, with its absent vertices.
#pragma once

#include "estimate/completion.h"
#include "grid/refined_signs.h"
#include "scalars/scalars.h"
#include "util/cold_path.h"

namespace isostar {

/// The members of a coarser level's set of vertices, on the next level's lattice.
template <int D>
[[nodiscard]] ISOSTAR_COLD Signs<D> onFinerLevel(const Signs<D>& coarse) {
  Signs<D> fine(coarse.lattice().finer());
  forEachMember(coarse,
                [&](const Coordinates<D>& v) { fine.set(coarse.lattice().onFiner(v), true); });
  return fine;
}

/// Is a vertex of a level, which is not `absent`, a vertex of a simplex that is not split further?
/// `finer`: the absent vertices of the next level; null if there is none.
template <int D>
[[nodiscard]] ISOSTAR_COLD bool belongsToLeaf(const Signs<D>& absent, const Signs<D>* finer,
                                              const Coordinates<D>& v) {
  if (absent.at(v)) return false;
  if (finer == nullptr) return true;
  const auto middle = absent.lattice().onFiner(v);
  Coordinates<D> low, high;
  for (int a = 0; a < D; ++a) {
    low[a] = std::max(middle[a] - 1, 0);
    high[a] = std::min(middle[a] + 1, finer->lattice().last[a]);
  }
  bool any = false;
  forEachBetween<D>(low, high, [&](const Coordinates<D>& w) { any = any || finer->at(w); });
  return any;
}

/// The vertices of a level. Absent ones have the values of the simplices that they lie in.
template <int D>
struct AdaptiveLevel {
  Signs<D> signs;
  Scalars<D> scalars;           // coded, taken from the coarser level, or interpolated
  std::vector<uint8_t> active;  // as of activeBricks(signs)

  AdaptiveLevel() = default;
  /// The state before the level's own scalars are coded. `coded`: the level's signs; `coarser`: the
  /// coarser level, null for the base.
  ISOSTAR_COLD AdaptiveLevel(const Signs<D>& coded, const Signs<D>& absent,
                             const AdaptiveLevel* coarser)
      : signs(coded), scalars(coded.table().total()) {
    if (coarser != nullptr) {
      takeOver(*coarser);
      interpolate(absent, *coarser);
    }
    active = activeBricks(signs);
  }
  /// Bytes needed at most for this.
  [[nodiscard]] static uint64_t memoryToMake(const Signs<D>& coded, const Signs<D>& absent,
                                             const AdaptiveLevel* coarser) {
    const uint64_t tableSize = coded.table().total(), absentBricks = absent.brickCount();
    const uint64_t taken =
        coarser == nullptr ? 0 : (uint64_t{coarser->scalars.brickCount()} << D) + absentBricks;
    return tableSize + Signs<D>::memoryToFill(tableSize, coded.brickCount() + absentBricks) +
           Scalars<D>::memoryOf(tableSize, std::min(tableSize, taken));
  }

  /// Bytes in use while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    return signs.memory() + scalars.memory() + active.size();
  }
  /// Bytes needed at most for estimate(), with those in use: the known bricks are copied.
  [[nodiscard]] uint64_t memoryToEstimate() const {
    const auto bricks = scalars.brickCount() +
                        static_cast<std::size_t>(std::count(active.begin(), active.end(), 1));
    return memory() + 2 * Scalars<D>::memoryOf(active.size(), bricks);
  }

  /// Replaces what is interpolated by known scalars.
  ISOSTAR_COLD void take(const Scalars<D>& known) {
    for (std::size_t brickIndex = 0; brickIndex < known.tableSize(); ++brickIndex) {
      if (known.hasGradient(brickIndex))
        scalars.setGradient(brickIndex, known.gradient(brickIndex));
      if (!known.has(brickIndex)) continue;
      const auto& from = known.at(brickIndex);
      auto& brick = scalars.writable(brickIndex);
      for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
        if (from.knows(i)) brick.value[i] = from.value[i];
      }
    }
  }

  /// Estimates the missing scalars of leaves. Values are 2^finer times as large: a coarse level's
  /// are multiplied by the ratio of its grid step to that of the last level. Vertices of other
  /// leaves are estimated better on finer levels. `absent`: as of the constructor; `finerAbsent`:
  /// of the next level, null if this is the last. `gradient`: as of estimateMissing().
  ISOSTAR_COLD void estimate(const Signs<D>& absent, const Signs<D>* finerAbsent, int finer,
                             const Hints<D>& hints = {}, int gradient = kPlainGradient) {
    const Scalars<D> before = scalars;
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds})
      estimateMissing(signs, active, members, finer, scalars, hints, gradient);
    if (finerAbsent == nullptr) return;
    for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
      if (!scalars.has(brickIndex)) continue;
      auto& brick = scalars.writable(brickIndex);
      for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
        if (!brick.knows(i) || before.at(brickIndex).knows(i) ||
            belongsToLeaf<D>(absent, finerAbsent, vertexOf<D>(signs.table().brick(brickIndex), i)))
          continue;
        brick.value[i] = Scalars<D>::kUnknown;
      }
    }
  }

 private:
  [[nodiscard]] int32_t valueAt(const Coordinates<D>& v) const {
    return scalars.at(signs.table().brickIndexOf(v)).value[numberOf<D>(v)];
  }
  void setValue(const Coordinates<D>& v, int32_t value) {
    scalars.writable(signs.table().brickIndexOf(v)).value[numberOf<D>(v)] = value;
  }

  void takeOver(const AdaptiveLevel& coarser) {
    const auto& from = coarser.signs;
    for (std::size_t brickIndex = 0; brickIndex < from.table().total(); ++brickIndex) {
      if (!coarser.scalars.has(brickIndex)) continue;
      const auto& brick = coarser.scalars.at(brickIndex);
      for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
        if (brick.knows(i))
          setValue(from.lattice().onFiner(vertexOf<D>(from.table().brick(brickIndex), i)),
                   brick.value[i]);
      }
    }
  }

  /// Absent vertices take the coarser level's sign, if it has them, and then the mean of the ends
  /// of their refinement edge.
  void interpolate(const Signs<D>& absent, const AdaptiveLevel& coarser) {
    forEachMember(absent, [&](const Coordinates<D>& v) {
      if (const auto same = signs.lattice().onCoarser(v)) signs.set(v, coarser.signs.at(*same));
    });
    forEachMember(absent, [&](const Coordinates<D>& v) { halfway(v); });
  }

  void halfway(const Coordinates<D>& v) {
    const auto& lattice = signs.lattice();
    Coordinates<D> even = v, odd = v;
    for (int a = 0; a < D; ++a) {
      if (!lattice.isNew(a, v[a])) continue;
      const bool lowIsEven = lattice.parent(a, v[a]) % 2 == 0;
      (lowIsEven ? even : odd)[a] -= 1;
      (lowIsEven ? odd : even)[a] += 1;
    }
    if (even == odd) return;
    const int32_t from = valueAt(even), to = valueAt(odd);
    if (from == Scalars<D>::kUnknown || to == Scalars<D>::kUnknown) {
      signs.set(v, signs.at(even));
      return;
    }
    const auto mean = static_cast<int32_t>((int64_t{from} + to) / 2);
    const int32_t value = mean == 0 ? -1 : mean;
    signs.set(v, value > 0);
    setValue(v, value);
  }
};

}  // namespace isostar
