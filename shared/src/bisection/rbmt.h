// A mesh of the regular binary multi-triangulation (§4.2, §4.3), with splits, welds and the
// non-local transitions that they need.
#pragma once

#include <algorithm>
#include <vector>

#include "bisection/tagged_simplex.h"
#include "grid/signs.h"

namespace isostar {

/// A conforming mesh; the depths of adjacent simplices differ by at most one. It is stored as a set
/// of vertices that contains the parents of each of its vertices: a simplex is split if the set has
/// the middle of its refinement edge.
///
/// Vertices are in steps of the finest level. Arguments must not be negative nor beyond the padded
/// lattice, and must use the hierarchy's names for vertices. Vertices that the hierarchy does not
/// hold (the box has no simplices around them) are in no mesh.
template <int D>
class Rbmt {
 public:
  using Vertices = std::vector<Coordinates<D>>;

  Rbmt() = default;
  /// The base mesh (T⁰ of the paper).
  explicit Rbmt(const Hierarchy<D>& hierarchy)
      : hierarchy_(hierarchy), bits_(hierarchy.paddedLattice()) {}
  /// The full mesh: all vertices of all levels.
  [[nodiscard]] static Rbmt full(const Hierarchy<D>& hierarchy) {
    Rbmt mesh(hierarchy);
    mesh.bits_.fill(Signs<D>::kPositive);
    return mesh;
  }

  [[nodiscard]] const Hierarchy<D>& hierarchy() const { return hierarchy_; }
  /// Is the vertex in the mesh?
  [[nodiscard]] bool contains(const Coordinates<D>& v) const {
    return hierarchy_.holds(v) && (hierarchy_.isBase(v) || bits_.at(v));
  }
  /// Is a simplex, which is or was a leaf of the mesh, split?
  [[nodiscard]] bool splits(const TaggedSimplex<D>& s) const {
    return s.depth < hierarchy_.maxDepth() && bits_.at(s.middle());
  }
  /// Bytes in use.
  [[nodiscard]] std::size_t memory() const { return bits_.memory(); }

  /// Is the split of v's diamond a local transition? It is if all of v's parents are in the mesh.
  [[nodiscard]] bool canSplit(const Coordinates<D>& v) const {
    if (!splittable(v)) return false;
    bool ready = true;
    hierarchy_.forEachParent(hierarchy_.diamond(v),
                             [&](const Coordinates<D>& p) { ready = ready && contains(p); });
    return ready;
  }
  /// The smallest set of vertices that must be added for v to be in the mesh, v included and last,
  /// in an order in which each is a local split. Empty if v is in the mesh already or cannot be in
  /// any.
  void missing(const Coordinates<D>& v, Vertices& out) const {
    out.clear();
    if (!splittable(v)) return;
    closure(v, out, [&](const Coordinates<D>& u, auto&& push) {
      hierarchy_.forEachParent(hierarchy_.diamond(u), [&](const Coordinates<D>& p) {
        if (!contains(p)) push(p);
      });
    });
  }
  /// Splits v's diamond, after all that missing() lists. `added` receives the new vertices in
  /// order.
  void split(const Coordinates<D>& v, Vertices& added) {
    missing(v, added);
    for (const auto& u : added) bits_.set(u, true);
  }

  /// Is the weld of v a local transition? It is if none of v's children is in the mesh.
  [[nodiscard]] bool canWeld(const Coordinates<D>& v) const {
    if (!weldable(v)) return false;
    bool ready = true;
    hierarchy_.forEachChild(hierarchy_.diamond(v),
                            [&](const Coordinates<D>& c) { ready = ready && !bits_.at(c); });
    return ready;
  }
  /// The smallest set of vertices that must be removed for v to be removed, v included and last, in
  /// an order in which each is a local weld. Empty if v is not in the mesh or is of the base.
  void dependents(const Coordinates<D>& v, Vertices& out) const {
    out.clear();
    if (!weldable(v)) return;
    closure(v, out, [&](const Coordinates<D>& u, auto&& push) {
      hierarchy_.forEachChild(hierarchy_.diamond(u), [&](const Coordinates<D>& c) {
        if (bits_.at(c)) push(c);
      });
    });
  }
  /// Welds v's diamond, after all that dependents() lists. `removed` receives the removed vertices
  /// in order.
  void weld(const Coordinates<D>& v, Vertices& removed) {
    dependents(v, removed);
    for (const auto& u : removed) bits_.set(u, false);
  }

  /// Calls visit(vertex) for the mesh's vertices of one depth (1 … maxDepth), in an unspecified
  /// order. The visitor may split and weld; vertices of this depth that it adds may be visited or
  /// not.
  template <class Visit>
  void forEachVertex(int depth, Visit&& visit) const {
    const int32_t half = int32_t{1} << (hierarchy_.finestLevel() - 1 - (depth - 1) / D);
    const int axes = D - (depth - 1) % D;
    for (std::size_t brickIndex = 0; brickIndex < bits_.table().total(); ++brickIndex) {
      if (bits_.slot(brickIndex) == Signs<D>::kNegative) continue;
      Coordinates<D> lowest = bits_.table().brick(brickIndex);
      for (int32_t& x : lowest) x *= kBrickSide;
      for (unsigned newAxes = 1; newAxes < 1u << D; ++newAxes) {
        if (Diamond<D>{{}, half, newAxes, depth}.axes() == axes)
          forEachInBrick(lowest, half, newAxes, visit);
      }
    }
  }

 private:
  [[nodiscard]] bool splittable(const Coordinates<D>& v) const {
    return hierarchy_.holds(v) && !contains(v);
  }
  [[nodiscard]] bool weldable(const Coordinates<D>& v) const {
    return !hierarchy_.isBase(v) && contains(v);
  }

  /// v and all vertices that `next` leads to, generation by generation, the furthest one first. A
  /// generation is one depth: none of its vertices can appear in another.
  template <class Next>
  static void closure(const Coordinates<D>& v, Vertices& out, Next next) {
    out.push_back(v);
    std::size_t begin = 0;
    while (begin < out.size()) {
      const std::size_t end = out.size();
      for (std::size_t i = begin; i < end; ++i) {
        const auto u = out[i];
        next(u, [&](const Coordinates<D>& other) { out.push_back(other); });
      }
      const auto generation = out.begin() + static_cast<std::ptrdiff_t>(end);
      std::sort(generation, out.end());
      out.erase(std::unique(generation, out.end()), out.end());
      begin = end;
    }
    std::reverse(out.begin(), out.end());
  }

  /// Visits the mesh's vertices in a brick that have these new axes, on the level whose planes are
  /// `half` apart. `lowest`: the brick's first vertex.
  template <class Visit>
  void forEachInBrick(const Coordinates<D>& lowest, int32_t half, unsigned newAxes,
                      Visit& visit) const {
    const int32_t stride = 2 * half;
    Coordinates<D> first, last;
    for (int a = 0; a < D; ++a) {
      const int32_t phase = (newAxes >> a & 1) != 0 ? half : 0;
      first[a] = (lowest[a] - phase + stride - 1) / stride * stride + phase;
      if (lowest[a] < phase) first[a] = phase;
      last[a] = std::min(lowest[a] + kBrickSide - 1, bits_.lattice().last[a]);
      if (first[a] > last[a]) return;
    }
    for (auto v = first;;) {
      if (contains(v)) visit(v);
      int a = 0;
      for (; a < D; ++a) {
        v[a] += stride;
        if (v[a] <= last[a]) break;
        v[a] = first[a];
      }
      if (a == D) return;
    }
  }

  Hierarchy<D> hierarchy_;
  Signs<D> bits_;
};

}  // namespace isostar
