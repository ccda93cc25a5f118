// The vertices of one refinement level of the RBMT (§4.2), clipped to the source's box.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

namespace isostar {

template <int D>
using Coordinates = std::array<int32_t, D>;

/// The lattice of one refinement level of a box with samples 0 … last on each axis: planes at
/// multiples of `step`, and one at the box's end. D bisections lead from a level to the next finer
/// one, which has half the step. A cell at the end of the box that is too short to be halved stays
/// whole, so that no vertex lies outside the box and none exists twice.
///
/// Vertices are given by their planes, 0 … last on each axis.
template <int D>
struct Lattice {
  Coordinates<D> box{};   // last sample on each axis
  Coordinates<D> last{};  // last plane on each axis
  int32_t step = 1;       // samples between planes

  Lattice() = default;
  Lattice(const Coordinates<D>& lastSample, int32_t spacing) : box(lastSample), step(spacing) {
    for (int a = 0; a < D; ++a) last[a] = (box[a] + step - 1) / step;
  }

  /// The next finer level; only where `step` is even.
  [[nodiscard]] Lattice finer() const { return Lattice(box, step / 2); }
  /// The sample on an axis at which a plane lies.
  [[nodiscard]] int32_t sample(int axis, int32_t plane) const {
    return std::min(plane * step, box[axis]);
  }
  /// The sample at which a vertex lies.
  [[nodiscard]] Coordinates<D> samples(Coordinates<D> planes) const {
    for (int a = 0; a < D; ++a) planes[a] = sample(a, planes[a]);
    return planes;
  }
  /// Is the plane one that the next coarser level does not have?
  [[nodiscard]] bool isNew(int axis, int32_t plane) const {
    return (plane & 1) != 0 && plane != last[axis];
  }
  /// The axes on which a vertex is new: bit a for axis a.
  [[nodiscard]] unsigned newAxes(const Coordinates<D>& v) const {
    unsigned axes = 0;
    for (int a = 0; a < D; ++a) axes |= isNew(a, v[a]) ? 1u << a : 0u;
    return axes;
  }
  /// The plane of the next coarser level that coincides with this one or, for a new plane, precedes
  /// it.
  [[nodiscard]] int32_t parent(int axis, int32_t plane) const {
    return plane == last[axis] ? (plane + 1) / 2 : plane / 2;
  }
  /// The same vertex in planes of the next coarser level; nothing if it is new.
  [[nodiscard]] std::optional<Coordinates<D>> onCoarser(const Coordinates<D>& v) const {
    Coordinates<D> same;
    for (int a = 0; a < D; ++a) {
      if (isNew(a, v[a])) return std::nullopt;
      same[a] = parent(a, v[a]);
    }
    return same;
  }
  /// The same vertex in planes of the next finer level.
  [[nodiscard]] Coordinates<D> onFiner(const Coordinates<D>& v) const {
    const Coordinates<D> end = finer().last;
    Coordinates<D> same;
    for (int a = 0; a < D; ++a) same[a] = v[a] == last[a] ? end[a] : 2 * v[a];
    return same;
  }
  /// Reflects a plane outside the lattice into it, so that two-sided neighbourhoods need no special
  /// cases at the border. Planes whose mirror image lies outside, too, are clamped.
  [[nodiscard]] int32_t mirrored(int axis, int32_t plane) const {
    if (plane < 0) plane = -plane;
    if (plane > last[axis]) plane = 2 * last[axis] - plane;
    return std::clamp(plane, 0, last[axis]);
  }
  /// How many vertices the lattice has.
  [[nodiscard]] uint64_t vertices() const {
    uint64_t n = 1;
    for (int a = 0; a < D; ++a) n *= static_cast<uint64_t>(last[a]) + 1;
    return n;
  }
};

/// Calls visit(axis) for each axis, a std::integral_constant each time: for innermost loops, which
/// some compilers would not unroll.
template <int D, class Visit>
void forEachAxis(Visit visit) {
  [&]<int... Axes>(std::integer_sequence<int, Axes...>) {
    (visit(std::integral_constant<int, Axes>()), ...);
  }
  (std::make_integer_sequence<int, D>());
}

/// Calls visit(v) for all vertices between two corners, both included, the first axis fastest.
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
