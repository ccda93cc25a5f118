// The diamonds of the RBMT (§4.2, §4.3) in closed form: which vertex splits which edge, and which
// vertices must come before it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "grid/lattice.h"

namespace isostar {

/// All simplices around one refinement edge, named by the vertex in the edge's middle, which splits
/// them when it is added. Coordinates are in steps of the finest level.
template <int D>
struct Diamond {
  Coordinates<D> vertex{};
  /// Distance from the vertex to either end of the edge on each axis along which the edge runs.
  int32_t half = 1;
  unsigned newAxes = 0;  // bit a: the edge runs along axis a
  int depth = 0;         // of the simplices that the split creates

  /// Does the edge run along an axis?
  [[nodiscard]] bool along(int axis) const { return (newAxes >> axis & 1) != 0; }
  /// How many axes the edge runs along.
  [[nodiscard]] int axes() const {
    int count = 0;
    for (int a = 0; a < D; ++a) count += along(a);
    return count;
  }
  /// The end whose planes are even in the edge's own level. Cells mirror each other, so diagonals
  /// meet in even corners.
  [[nodiscard]] Coordinates<D> evenEnd() const {
    Coordinates<D> end = vertex;
    for (int a = 0; a < D; ++a) {
      if (along(a)) end[a] += ((vertex[a] - half) / (2 * half)) % 2 == 0 ? -half : half;
    }
    return end;
  }
  /// The other end.
  [[nodiscard]] Coordinates<D> oddEnd() const {
    Coordinates<D> end = evenEnd();
    for (int a = 0; a < D; ++a) end[a] = 2 * vertex[a] - end[a];
    return end;
  }
};

/// The vertices that meshes of a box may have, in steps of the finest level, and which of them
/// depend on which.
///
/// The lattice is padded to whole cells of the base. A vertex beyond the box's end lies *at* the
/// end (`position`), so that the hierarchy is as regular as an infinite one. Simplices that are
/// flat there are no simplices of the box, and a vertex around which all are flat does not exist
/// (`holds`).
template <int D>
class Hierarchy {
 public:
  using Vertex = Coordinates<D>;  // in steps of the finest level

  Hierarchy() = default;
  /// A box with samples 0 … lastSample. `finestLevel`: how often cells of the base are halved, at
  /// most 20; the padded lattice must have fewer than 2³⁰ planes on each axis. A box without extent
  /// on some axis has no simplices.
  Hierarchy(const Coordinates<D>& lastSample, int finestLevel)
      : box_(lastSample),
        finestLevel_(finestLevel),
        padded_(std::any_of(box_.begin(), box_.end(),
                            [&](int32_t last) { return last % baseStep() != 0; })) {}

  /// The last sample on each axis.
  [[nodiscard]] const Coordinates<D>& box() const { return box_; }
  /// The number of refinement levels above the base.
  [[nodiscard]] int finestLevel() const { return finestLevel_; }
  /// The depth of simplices of the finest level.
  [[nodiscard]] int maxDepth() const { return D * finestLevel_; }
  /// The side of a cell of the base.
  [[nodiscard]] int32_t baseStep() const { return int32_t{1} << finestLevel_; }
  /// The number of cells of the base along an axis.
  [[nodiscard]] int32_t baseCells(int axis) const {
    return (box_[axis] + baseStep() - 1) / baseStep();
  }
  /// The lattice of all coordinates that a vertex may have.
  [[nodiscard]] Lattice<D> paddedLattice() const {
    Coordinates<D> last;
    for (int a = 0; a < D; ++a) last[a] = baseCells(a) * baseStep();
    return Lattice<D>(last, 1);
  }

  /// The sample at which the vertex lies.
  [[nodiscard]] Coordinates<D> position(Coordinates<D> v) const {
    for (int a = 0; a < D; ++a) v[a] = std::min(v[a], box_[a]);
    return v;
  }
  /// Is a simplex with these vertices flat because it lies beyond the box's end on some axis? All
  /// others have a positive volume.
  template <class Vertices>
  [[nodiscard]] bool flat(const Vertices& vertices) const {
    if (!padded_) return false;
    for (int a = 0; a < D; ++a) {
      if (std::all_of(vertices.begin(), vertices.end(),
                      [&](const Coordinates<D>& v) { return v[a] >= box_[a]; }))
        return true;
    }
    return false;
  }

  /// Is the vertex one of the base's?
  [[nodiscard]] bool isBase(const Coordinates<D>& v) const {
    return (bits(v) & (baseStep() - 1)) == 0;
  }
  /// The diamond of a vertex, which must not be of the base.
  [[nodiscard]] Diamond<D> diamond(const Coordinates<D>& v) const {
    const int32_t all = bits(v);
    Diamond<D> d{v, all & -all, 0, 0};
    for (int a = 0; a < D; ++a) d.newAxes |= (v[a] & d.half) != 0 ? 1u << a : 0u;
    for (int32_t step = d.half * 2; step < baseStep(); step *= 2) d.depth += D;
    d.depth += D - d.axes() + 1;
    return d;
  }
  /// Can a mesh of the box have simplices around the vertex? Coordinates must not be negative.
  [[nodiscard]] bool holds(const Coordinates<D>& v) const {
    const int32_t half = isBase(v) ? baseStep() : bits(v) & -bits(v);
    for (int a = 0; a < D; ++a) {
      if (v[a] - half >= box_[a] || box_[a] == 0) return false;
    }
    return true;
  }

  /// Calls visit(vertex) for the newest vertex of each of the diamond's simplices. Their depth is
  /// one less than the diamond's. If they are in a mesh, so are the edge and all simplices around
  /// it. There are D of them for a cell's centre, else 2 for each axis that the edge does not run
  /// along.
  template <class Visit>
  void forEachParent(const Diamond<D>& d, Visit&& visit) const {
    if (d.axes() == D) {
      const auto even = d.evenEnd(), odd = d.oddEnd();
      for (int a = 0; a < D; ++a) {
        Coordinates<D> parent = even;
        parent[a] = odd[a];
        visit(parent);
      }
      return;
    }
    for (int a = 0; a < D; ++a) {
      if (d.along(a)) continue;
      if (d.vertex[a] > 0) visit(moved(d.vertex, a, -d.half));
      if (d.vertex[a] < box_[a]) visit(moved(d.vertex, a, d.half));
    }
  }

  /// Calls visit(vertex) for the vertices that have this one as a parent. Their depth is one more
  /// than the diamond's. There are 2 for each axis along which the edge runs, and 2^D on the next
  /// level where that is one axis only.
  template <class Visit>
  void forEachChild(const Diamond<D>& d, Visit&& visit) const {
    if (d.axes() == 1) return forEachChildOfNextLevel(d, visit);
    for (int a = 0; a < D; ++a) {
      if (!d.along(a)) continue;
      for (int32_t by : {-d.half, d.half}) visitHeld(moved(d.vertex, a, by), visit);
    }
  }

 private:
  [[nodiscard]] static int32_t bits(const Coordinates<D>& v) {
    int32_t all = 0;
    for (int32_t x : v) all |= x;
    return all;
  }
  [[nodiscard]] static Coordinates<D> moved(Coordinates<D> v, int axis, int32_t by) {
    v[axis] += by;
    return v;
  }
  template <class Visit>
  void visitHeld(const Coordinates<D>& v, Visit& visit) const {
    if (std::all_of(v.begin(), v.end(), [](int32_t x) { return x >= 0; }) && holds(v)) visit(v);
  }
  template <class Visit>
  void forEachChildOfNextLevel(const Diamond<D>& d, Visit& visit) const {
    if (d.half == 1) return;
    for (unsigned up = 0; up < 1u << D; ++up) {
      Coordinates<D> child = d.vertex;
      for (int a = 0; a < D; ++a) child[a] += (up >> a & 1) != 0 ? d.half / 2 : -d.half / 2;
      visitHeld(child, visit);
    }
  }

  Coordinates<D> box_{};
  int finestLevel_ = 0;
  bool padded_ = false;
};

}  // namespace isostar
