// What is known of one level of an adaptive mesh, with its absent vertices.
#pragma once

#include "grid/refined_signs.h"
#include "scalars/scalars.h"
#include "util/cold_path.h"

namespace isostar {

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
