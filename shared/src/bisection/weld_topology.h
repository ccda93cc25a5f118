// Topology control (§4.3): does a weld keep the isosurface's topology?
#pragma once

#include "bisection/leaves.h"

namespace isostar {

/// The vertices of one sign in the link of a diamond's edge, and the simplices that they span
/// there. A simplex is a set of vertices as bits.
template <int D>
class LinkPart {
  static_assert(D == 2 || D == 3 || D == 4,
                "a link has up to 26 vertices, bits of a word, and holes of one kind");

 public:
  LinkPart(const Diamond<D>& d, const Hierarchy<D>& hierarchy, bool sign, const auto& positive) {
    forEachSimplexOf(d, hierarchy, [&](const TaggedSimplex<D>& s) {
      uint32_t facet = 0;
      for (int i = 1; i <= D; ++i) {
        if (i != s.tag && positive(s.vertices[i]) == sign)
          facet |= uint32_t{1} << number(s.vertices[i]);
      }
      for (uint32_t face = facet; face != 0; face = (face - 1) & facet) faces_.push_back(face);
    });
    std::sort(faces_.begin(), faces_.end());
    faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
  }

  /// Is it connected and without holes?
  [[nodiscard]] bool contractible() const { return eulerCharacteristic() == 1 && connected(); }

 private:
  uint32_t number(const Coordinates<D>& v) {
    const auto at = std::find(vertices_.begin(), vertices_.end(), v) - vertices_.begin();
    if (at == static_cast<std::ptrdiff_t>(vertices_.size())) vertices_.push_back(v);
    return static_cast<uint32_t>(at);
  }
  static int count(uint32_t face) {
    int n = 0;
    for (; face != 0; face &= face - 1) ++n;
    return n;
  }
  [[nodiscard]] int eulerCharacteristic() const {
    int sum = 0;
    for (uint32_t face : faces_) sum += count(face) % 2 == 1 ? 1 : -1;
    return sum;
  }
  [[nodiscard]] bool connected() const {
    uint32_t all = 0, reached = faces_.empty() ? 0 : faces_.front();
    for (uint32_t face : faces_) all |= face;
    for (uint32_t before = 0; before != reached;) {
      before = reached;
      for (uint32_t face : faces_) reached |= (face & reached) != 0 ? face : 0;
    }
    return reached == all;
  }

  std::vector<Coordinates<D>> vertices_;
  std::vector<uint32_t> faces_;
};

/// Does a weld keep the topology where the vertex lies beyond the box's end in the direction `axis`
/// of its own edge? Then the vertex lies in the box's boundary although its edge does not, and the
/// weld changes the triangulation of that part of the boundary. That is harmless if the part has
/// one sign.
template <int D>
bool endKeepsTopology(const Diamond<D>& d, const Hierarchy<D>& hierarchy, int axis,
                      const auto& positive) {
  bool same = true;
  forEachSimplexOf(d, hierarchy, [&](const TaggedSimplex<D>& s) {
    for (const auto& v : s.vertices) {
      same = same && (v[axis] < hierarchy.box()[axis] || positive(v) == positive(d.vertex));
    }
  });
  return same;
}

/// Is the isosurface in the star of v after the weld of v the same up to a deformation that leaves
/// the star's boundary fixed? v must not have children in the mesh. `positive(vertex)` → bool: the
/// signs.
///
/// Sufficient in the dimensions supported: the edge is crossed at most once, that is, one of its
/// ends has v's sign. If it is crossed twice, the answer is yes exactly if both signs' parts of the
/// edge's link are contractible. docs/codec/topology.md explains why.
template <int D>
bool weldKeepsTopology(const Hierarchy<D>& hierarchy, const typename Hierarchy<D>::Vertex& v,
                       const auto& positive) {
  const auto d = hierarchy.diamond(v);
  for (int a = 0; a < D; ++a) {
    if (!d.along(a) || v[a] < hierarchy.box()[a]) continue;
    if (d.axes() == 1) return true;  // v coincides with an end of the edge
    if (!endKeepsTopology(d, hierarchy, a, positive)) return false;
  }
  const bool sign = positive(v);
  if (positive(d.evenEnd()) == sign || positive(d.oddEnd()) == sign) return true;
  return LinkPart<D>(d, hierarchy, false, positive).contractible() &&
         LinkPart<D>(d, hierarchy, true, positive).contractible();
}

}  // namespace isostar
