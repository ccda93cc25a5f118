// What is known of an octave of an adaptive mesh, absent vertices included.
#pragma once

#include "grid/refined_signs.h"
#include "scalars/scalars.h"
#include "util/cold_path.h"

namespace isostar {

/// Of an octave's vertices, where those that are not in the mesh have the values of the simplices
/// they lie in.
template <int D>
struct AdaptiveLevel {
  Signs<D> signs;
  Scalars<D> scalars;           // told, taken over from the coarser octave, or interpolated
  std::vector<uint8_t> active;  // as of activeBricks(signs)

  AdaptiveLevel() = default;
  /// Before its own scalars are told: from its signs and absent vertices and, null for the base,
  /// the coarser octave.
  ISOSTAR_COLD AdaptiveLevel(const Signs<D>& coded, const Signs<D>& absent,
                             const AdaptiveLevel* coarser)
      : signs(coded), scalars(coded.table().total()) {
    if (coarser != nullptr) {
      takeOver(*coarser);
      interpolate(absent, *coarser);
    }
    active = activeBricks(signs);
  }
  /// Bytes that this takes at most.
  [[nodiscard]] static uint64_t memoryToMake(const Signs<D>& coded, const Signs<D>& absent,
                                             const AdaptiveLevel* coarser) {
    const uint64_t brickIndices = coded.table().total(), absentBricks = absent.brickCount();
    const uint64_t taken =
        coarser == nullptr ? 0 : (uint64_t{coarser->scalars.brickCount()} << D) + absentBricks;
    return brickIndices + Signs<D>::memoryToFill(brickIndices, coded.brickCount() + absentBricks) +
           Scalars<D>::memoryOf(brickIndices, std::min(brickIndices, taken));
  }

  /// Bytes in use, while one more brick is made.
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

  /// Absent vertices: those of the coarser octave as they are there, the others halfway between the
  /// ends of their refinement edge.
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
