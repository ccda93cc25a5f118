// The leaves of a mesh of the RBMT, found by recursion from the base: simplices are never stored.
#pragma once

#include "bisection/rbmt.h"

namespace isostar {

/// Calls visit(leaf) for the leaves below a simplex; for the simplex itself if it is a leaf.
/// enter(simplex) says for each simplex on the way whether to descend into it.
template <int D, class Enter, class Visit>
void forEachLeafBelow(const Rbmt<D>& mesh, const TaggedSimplex<D>& s, Enter& enter, Visit& visit) {
  if (mesh.hierarchy().flat(s.vertices) || !enter(s)) return;
  if (!mesh.splits(s)) {
    visit(s);
    return;
  }
  for (const auto& half : s.halves()) forEachLeafBelow(mesh, half, enter, visit);
}

/// Calls visit(cell) for the cells of the base from `first` to below `end` on each axis.
template <int D, class Visit>
void forEachBaseCell(const Coordinates<D>& first, const Coordinates<D>& end, Visit&& visit) {
  for (int a = 0; a < D; ++a) {
    if (first[a] >= end[a]) return;
  }
  for (auto cell = first;;) {
    visit(cell);
    int a = 0;
    for (; a < D && ++cell[a] == end[a]; ++a) cell[a] = first[a];
    if (a == D) return;
  }
}

/// Calls visit(leaf) for the mesh's leaves, except those below a simplex for which enter(simplex)
/// is false.
template <int D, class Enter, class Visit>
void forEachLeaf(const Rbmt<D>& mesh, Enter enter, Visit visit) {
  Coordinates<D> end;
  for (int a = 0; a < D; ++a) end[a] = mesh.hierarchy().baseCells(a);
  forEachBaseCell<D>({}, end, [&](const Coordinates<D>& cell) {
    forEachBaseSimplex(mesh.hierarchy(), cell,
                       [&](const auto& s) { forEachLeafBelow(mesh, s, enter, visit); });
  });
}
template <int D, class Visit>
void forEachLeaf(const Rbmt<D>& mesh, Visit visit) {
  forEachLeaf(
      mesh, [](const TaggedSimplex<D>&) { return true; }, visit);
}

/// Calls visit(leaf) for the star of a vertex of the mesh: the leaves that have it as a vertex.
template <int D, class Visit>
void forEachLeafAround(const Rbmt<D>& mesh, const typename Hierarchy<D>::Vertex& v, Visit visit) {
  const auto& hierarchy = mesh.hierarchy();
  auto enter = [&](const TaggedSimplex<D>& s) { return s.has(v); };
  auto look = [&](const TaggedSimplex<D>& s) { forEachLeafBelow(mesh, s, enter, visit); };
  if (!hierarchy.isBase(v)) {
    forEachSimplexOf(hierarchy.diamond(v), hierarchy, [&](const TaggedSimplex<D>& s) {
      for (const auto& half : s.halves()) look(half);
    });
    return;
  }
  Coordinates<D> first, end;
  for (int a = 0; a < D; ++a) {
    const int32_t plane = v[a] / hierarchy.baseStep();
    first[a] = std::max(plane - 1, 0);
    end[a] = std::min(plane + 1, hierarchy.baseCells(a));
  }
  forEachBaseCell<D>(
      first, end, [&](const Coordinates<D>& cell) { forEachBaseSimplex(hierarchy, cell, look); });
}

/// Which signs the samples of a brick between two corners (inclusive, in the brick's coordinates 0
/// … 7) have: bit 0 negative, bit 1 positive.
template <int D>
unsigned signsBetween(const Brick<D>& brick, const typename Hierarchy<D>::Vertex& lowest,
                      const typename Hierarchy<D>::Vertex& highest) {
  const unsigned mask = (0xFFu >> (7 - (highest[0] - lowest[0]))) << lowest[0] & 0xFF;
  unsigned seen = 0;
  for (auto v = lowest;;) {
    std::size_t row = 0;
    for (int a = D - 1; a >= 1; --a) row = row * kBrickSide + static_cast<std::size_t>(v[a]);
    const unsigned bits = brick.rows[row] & mask;
    seen |= (bits != 0 ? 2u : 0u) | (bits != mask ? 1u : 0u);
    int a = 1;
    for (; a < D && ++v[a] > highest[a]; ++a) v[a] = lowest[a];
    if (a == D || seen == 3) return seen;
  }
}

/// Do the samples between two corners (inclusive, in the box) have both signs?
template <int D>
bool crossesBetween(const Signs<D>& signs, const typename Hierarchy<D>::Vertex& lowest,
                    const typename Hierarchy<D>::Vertex& highest) {
  Coordinates<D> first, end;
  for (int a = 0; a < D; ++a) {
    first[a] = lowest[a] / kBrickSide;
    end[a] = highest[a] / kBrickSide + 1;
  }
  unsigned seen = 0;
  for (auto at = first;;) {
    const uint32_t index = signs.slot(signs.table().index(at));
    if (index <= Signs<D>::kPositive) {
      seen |= 1u << index;
    } else {
      Coordinates<D> low, high;
      for (int a = 0; a < D; ++a) {
        low[a] = std::max(lowest[a] - at[a] * kBrickSide, 0);
        high[a] = std::min(highest[a] - at[a] * kBrickSide, kBrickSide - 1);
      }
      seen |= signsBetween<D>(signs.brick(index), low, high);
    }
    if (seen == 3) return true;
    int a = 0;
    for (; a < D && ++at[a] == end[a]; ++a) at[a] = first[a];
    if (a == D) return false;
  }
}

/// May samples inside a simplex have both signs? Tests the axis-aligned box around it. `signs`:
/// those of the box's samples.
template <int D>
bool mayCross(const Signs<D>& signs, const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s) {
  return crossesBetween(signs, hierarchy.position(s.lowest()), hierarchy.position(s.highest()));
}

/// Does the simplex have vertices of both signs?
template <int D>
bool crosses(const Signs<D>& signs, const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s) {
  const bool first = signs.at(hierarchy.position(s.vertices[0]));
  return std::any_of(s.vertices.begin() + 1, s.vertices.end(), [&](const Coordinates<D>& v) {
    return signs.at(hierarchy.position(v)) != first;
  });
}

/// Calls visit(leaf) for the tube (§3): the leaves with vertices of both signs. `signs`: those of
/// the box's samples.
template <int D, class Visit>
void forEachCrossingLeaf(const Rbmt<D>& mesh, const Signs<D>& signs, Visit visit) {
  const auto& hierarchy = mesh.hierarchy();
  forEachLeaf(
      mesh, [&](const TaggedSimplex<D>& s) { return mayCross(signs, hierarchy, s); },
      [&](const TaggedSimplex<D>& leaf) {
        if (crosses(signs, hierarchy, leaf)) visit(leaf);
      });
}

}  // namespace isostar
