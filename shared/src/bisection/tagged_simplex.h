// A simplex of the RBMT at any depth (§4.2): bisection by Maubach's tags, in integers.
#pragma once

#include <algorithm>
#include <numeric>

#include "bisection/diamond.h"
#include "grid/simplex.h"

namespace isostar {

/// Vertices 0 … tag are a path along the axes of a cube, from an even corner to the opposite odd
/// corner. The refinement edge is that diagonal. The vertices behind them are the centres of ever
/// larger cubes around it, in reverse order of creation. Coordinates are in steps of the finest
/// level.
template <int D>
struct TaggedSimplex {
  std::array<Coordinates<D>, D + 1> vertices{};
  int tag = D;
  int depth = 0;          // number of bisections since the base
  bool mirrored = false;  // the edges from vertex 0 form a left-handed frame

  /// The vertex that would split it. It names the diamond around the refinement edge.
  [[nodiscard]] Coordinates<D> middle() const {
    Coordinates<D> m;
    for (int a = 0; a < D; ++a) m[a] = (vertices[0][a] + vertices[tag][a]) / 2;
    return m;
  }
  /// The half at the even end, then the one at the odd end.
  [[nodiscard]] std::array<TaggedSimplex, 2> halves() const {
    std::array<TaggedSimplex, 2> both{*this, *this};
    const auto m = middle();
    both[0].vertices[tag] = m;
    std::copy(vertices.begin() + 1, vertices.begin() + tag + 1, both[1].vertices.begin());
    both[1].vertices[tag] = m;
    both[1].mirrored = mirrored != ((tag & 1) != 0);
    for (auto& half : both) {
      half.tag = tag > 1 ? tag - 1 : D;
      ++half.depth;
    }
    return both;
  }
  /// Is v one of its vertices?
  [[nodiscard]] bool has(const Coordinates<D>& v) const {
    return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
  }
  /// The least coordinate of its vertices on each axis.
  [[nodiscard]] Coordinates<D> lowest() const {
    return extreme([](int32_t x, int32_t y) { return std::min(x, y); });
  }
  /// The greatest coordinate of its vertices on each axis.
  [[nodiscard]] Coordinates<D> highest() const {
    return extreme([](int32_t x, int32_t y) { return std::max(x, y); });
  }

 private:
  template <class Choose>
  [[nodiscard]] Coordinates<D> extreme(Choose choose) const {
    Coordinates<D> chosen = vertices[0];
    for (const auto& v : vertices) {
      for (int a = 0; a < D; ++a) chosen[a] = choose(chosen[a], v[a]);
    }
    return chosen;
  }
};

/// Is an order of axes an odd permutation?
template <int D>
bool oddOrder(const auto& axes) {
  bool odd = false;
  for (int i = 0; i < D; ++i) {
    for (int j = i + 1; j < D; ++j) odd = odd != (axes[j] < axes[i]);
  }
  return odd;
}

/// Calls visit(TaggedSimplex) for the D! simplices of a cell of the base, except flat ones.
template <int D, class Visit>
void forEachBaseSimplex(const Hierarchy<D>& hierarchy, const typename Hierarchy<D>::Vertex& cell,
                        Visit&& visit) {
  for (uint32_t rank = 0; rank < Simplex<D>::perCell(); ++rank) {
    const auto kuhn = Simplex<D>::inCell(cell, rank);
    TaggedSimplex<D> s;
    s.mirrored = oddOrder<D>(kuhn.axes);
    for (int8_t direction : kuhn.direction) s.mirrored = s.mirrored != (direction < 0);
    for (int i = 0; i <= D; ++i) {
      s.vertices[i] = kuhn.vertex(i);
      for (int32_t& x : s.vertices[i]) x *= hierarchy.baseStep();
    }
    if (!hierarchy.flat(s.vertices)) visit(s);
  }
}

/// Calls visit(TaggedSimplex) for every simplex around the diamond's edge, as they are before its
/// split, except flat ones. The hierarchy must hold the diamond's vertex. If the edge runs along c
/// axes there are c! (D-c)! 2^(D-c) of them: each is a path along the edge's cube and a way
/// outwards.
template <int D, class Visit>
void forEachSimplexOf(const Diamond<D>& d, const Hierarchy<D>& hierarchy, Visit&& visit) {
  const int along = d.axes();
  const auto even = d.evenEnd(), odd = d.oddEnd();
  std::array<int, D> axes;
  std::iota(axes.begin(), axes.end(), 0);
  const auto across =
      std::stable_partition(axes.begin(), axes.end(), [&](int a) { return d.along(a); });
  do {
    do {
      for (unsigned upwards = 0; upwards < 1u << (D - along); ++upwards) {
        TaggedSimplex<D> s{{}, along, d.depth - 1, oddOrder<D>(axes)};
        s.vertices[0] = even;
        bool inside = true;
        for (int i = 0; i < D; ++i) {
          const int a = axes[i];
          const bool up = i < along ? odd[a] > even[a] : (upwards >> (i - along) & 1) != 0;
          s.mirrored = s.mirrored != !up;
          s.vertices[i + 1] = i == along ? d.vertex : s.vertices[i];
          s.vertices[i + 1][a] = i < along ? odd[a] : d.vertex[a] + (up ? d.half : -d.half);
          inside =
              inside && (i < along || (up ? d.vertex[a] < hierarchy.box()[a] : d.vertex[a] > 0));
        }
        if (inside) visit(s);
      }
    } while (std::next_permutation(across, axes.end()));
  } while (std::next_permutation(axes.begin(), across));
}

}  // namespace isostar
