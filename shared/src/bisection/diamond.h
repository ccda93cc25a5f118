// The diamonds of the RBMT (§4.2, §4.3) in closed form: which vertex splits which edge, after and
// before which others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "grid/lattice.h"

namespace isostar {

/// All simplices around one refinement edge, named by the vertex in the edge's middle, whose
/// arrival splits them.
template <int D>
struct Diamond {
  Coordinates<D> vertex{};
  int32_t half =
      1;  // from the vertex to either end of the edge, on each axis that the edge runs along
  unsigned newAxes = 0;  // bit a: the edge runs along axis a, the vertex is fresh there
  int depth = 0;         // of the simplices that the split makes: bisections since the base

  [[nodiscard]] bool along(int axis) const { return (newAxes >> axis & 1) != 0; }
  [[nodiscard]] int axes() const {
    int count = 0;
    for (int a = 0; a < D; ++a) count += along(a);
    return count;
  }
  /// The end whose planes are even in steps of the edge's octave; cells mirror each other, so the
  /// diagonals meet there.
  [[nodiscard]] Coordinates<D> evenEnd() const {
    Coordinates<D> end = vertex;
    for (int a = 0; a < D; ++a) {
      if (along(a)) end[a] += ((vertex[a] - half) / (2 * half)) % 2 == 0 ? -half : half;
    }
    return end;
  }
  [[nodiscard]] Coordinates<D> oddEnd() const {
    Coordinates<D> end = evenEnd();
    for (int a = 0; a < D; ++a) end[a] = 2 * vertex[a] - end[a];
    return end;
  }
};

/// The vertices that meshes of a box may have, in finest steps, and which of them wait for which.
///
/// The lattice is padded to whole cells of the base. A vertex beyond the box's end lies *at* the
/// end (`position`), so that the hierarchy is as regular as an endless one; simplices that are flat
/// there are no simplices of the box, and a vertex around which all are flat does not exist
/// (`holds`).
template <int D>
class Hierarchy {
 public:
  using Vertex = Coordinates<D>;  // in finest steps

  Hierarchy() = default;
  /// A box with samples 0 … lastSample; `octaves` is how often cells of the base are halved, at
  /// most 20, and less than 2³⁰ planes are padded. A box without extent on some axis has no
  /// simplices.
  Hierarchy(const Coordinates<D>& lastSample, int finestLevel)
      : box_(lastSample),
        finestLevel_(finestLevel),
        padded_(std::any_of(box_.begin(), box_.end(),
                            [&](int32_t last) { return last % baseStep() != 0; })) {}

  [[nodiscard]] const Coordinates<D>& box() const { return box_; }
  [[nodiscard]] int finestLevel() const { return finestLevel_; }
  [[nodiscard]] int maxDepth() const { return D * finestLevel_; }
  [[nodiscard]] int32_t baseStep() const { return int32_t{1} << finestLevel_; }
  /// Cells of the base on an axis.
  [[nodiscard]] int32_t baseCells(int axis) const {
    return (box_[axis] + baseStep() - 1) / baseStep();
  }
  /// All coordinates that a vertex may have.
  [[nodiscard]] Lattice<D> paddedLattice() const {
    Coordinates<D> last;
    for (int a = 0; a < D; ++a) last[a] = baseCells(a) * baseStep();
    return Lattice<D>(last, 1);
  }

  /// The sample that the vertex lies at.
  [[nodiscard]] Coordinates<D> position(Coordinates<D> v) const {
    for (int a = 0; a < D; ++a) v[a] = std::min(v[a], box_[a]);
    return v;
  }
  /// Is a simplex with these vertices flat, beyond the box's end on some axis? Otherwise its volume
  /// is positive.
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

  [[nodiscard]] bool isBase(const Coordinates<D>& v) const {
    return (bits(v) & (baseStep() - 1)) == 0;
  }
  /// The diamond of a vertex that is not of the base.
  [[nodiscard]] Diamond<D> diamond(const Coordinates<D>& v) const {
    const int32_t all = bits(v);
    Diamond<D> d{v, all & -all, 0, 0};
    for (int a = 0; a < D; ++a) d.newAxes |= (v[a] & d.half) != 0 ? 1u << a : 0u;
    for (int32_t step = d.half * 2; step < baseStep(); step *= 2) d.depth += D;
    d.depth += D - d.axes() + 1;
    return d;
  }
  /// Does a mesh of the box have simplices around the vertex? Coordinates are not negative.
  [[nodiscard]] bool holds(const Coordinates<D>& v) const {
    const int32_t half = isBase(v) ? baseStep() : bits(v) & -bits(v);
    for (int a = 0; a < D; ++a) {
      if (v[a] - half >= box_[a] || box_[a] == 0) return false;
    }
    return true;
  }

  /// The newest vertex of each of the diamond's simplices, each one level coarser than the diamond:
  /// with them the edge and all simplices around it are there. D of a cell's centre, else 2 for
  /// each axis that the edge is across.
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

  /// The vertices whose parent this one is, each one level finer: 2 for each axis that the edge
  /// runs along, 2^D of the next octave where it is one axis only.
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
