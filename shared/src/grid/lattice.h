// The vertices of one octave of the RBMT (§4.2), clipped to the source's box.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

namespace isostar {

template <int D>
using Coordinates = std::array<int32_t, D>;

/// Octave o of a box with samples 0 … last on each axis: planes at multiples of `step`, and one at
/// the box's end. Three bisections (in 3D; D in general) lead from an octave to the next, of half
/// the step. A cell at the end of the box that is too short to be halved stays whole, so that no
/// vertex lies outside the box and none exists twice.
template <int D>
struct Lattice {
  Coordinates<D> box{};   // last sample on each axis
  Coordinates<D> last{};  // last plane on each axis
  int32_t step = 1;       // samples between planes

  Lattice() = default;
  Lattice(const Coordinates<D>& lastSample, int32_t spacing) : box(lastSample), step(spacing) {
    for (int a = 0; a < D; ++a) last[a] = (box[a] + step - 1) / step;
  }

  [[nodiscard]] Lattice finer() const { return Lattice(box, step / 2); }
  [[nodiscard]] int32_t sample(int axis, int32_t plane) const {
    return std::min(plane * step, box[axis]);
  }
  [[nodiscard]] Coordinates<D> samples(Coordinates<D> planes) const {
    for (int a = 0; a < D; ++a) planes[a] = sample(a, planes[a]);
    return planes;
  }
  /// Does the plane first appear on this octave?
  [[nodiscard]] bool isNew(int axis, int32_t plane) const {
    return (plane & 1) != 0 && plane != last[axis];
  }
  /// The axes on which a vertex is fresh, as a set of bits.
  [[nodiscard]] unsigned newAxes(const Coordinates<D>& v) const {
    unsigned axes = 0;
    for (int a = 0; a < D; ++a) axes |= isNew(a, v[a]) ? 1u << a : 0u;
    return axes;
  }
  /// The coarser octave's plane that coincides with this one or, for a fresh one, precedes it.
  [[nodiscard]] int32_t parent(int axis, int32_t plane) const {
    return plane == last[axis] ? (plane + 1) / 2 : plane / 2;
  }
  /// Where a vertex is on the coarser octave; nothing if it is fresh.
  [[nodiscard]] std::optional<Coordinates<D>> onCoarser(const Coordinates<D>& v) const {
    Coordinates<D> same;
    for (int a = 0; a < D; ++a) {
      if (isNew(a, v[a])) return std::nullopt;
      same[a] = parent(a, v[a]);
    }
    return same;
  }
  /// Where a vertex is on the finer octave.
  [[nodiscard]] Coordinates<D> onFiner(const Coordinates<D>& v) const {
    const Coordinates<D> end = finer().last;
    Coordinates<D> same;
    for (int a = 0; a < D; ++a) same[a] = v[a] == last[a] ? end[a] : 2 * v[a];
    return same;
  }
  /// Mirrors a plane next to the box into it: two-sided neighbourhoods need no edge cases.
  [[nodiscard]] int32_t mirrored(int axis, int32_t plane) const {
    if (plane < 0) plane = -plane;
    if (plane > last[axis]) plane = 2 * last[axis] - plane;
    return std::clamp(plane, 0, last[axis]);
  }
  [[nodiscard]] uint64_t vertices() const {
    uint64_t n = 1;
    for (int a = 0; a < D; ++a) n *= static_cast<uint64_t>(last[a]) + 1;
    return n;
  }
};

/// Calls visit(axis) for each axis, which is a constant each time: for innermost loops, some of
/// which a compiler would leave as loops.
template <int D, class Visit>
void forEachAxis(Visit visit) {
  [&]<int... Axes>(std::integer_sequence<int, Axes...>) {
    (visit(std::integral_constant<int, Axes>()), ...);
  }
  (std::make_integer_sequence<int, D>());
}

/// Calls visit(v) for all vertices of a box, both corners included, the first axis fastest.
template <int D, class Visit>
void forEachBetween(const Coordinates<D>& low, const Coordinates<D>& high, Visit visit) {
  for (auto v = low;;) {
    visit(v);
    int a = 0;
    for (; a < D && ++v[a] > high[a]; ++a) v[a] = low[a];
    if (a == D) return;
  }
}

}  // namespace isostar
