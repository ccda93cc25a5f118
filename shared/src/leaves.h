// The simplices of a mesh of the RBMT, by recursion from the base: none is ever stored.
#pragma once

#include "rbmt.h"

namespace isostar {

/// Calls visit(leaf) for the leaves below a simplex, itself if it is one. enter(simplex) tells of each simplex on the
/// way whether to look into it.
template <int D, class Enter, class Visit>
void forEachLeafBelow(const Rbmt<D>& mesh, const TaggedSimplex<D>& s, Enter& enter, Visit& visit) {
  if (mesh.hierarchy().flat(s.vertices) || !enter(s)) return;
  if (!mesh.splits(s)) {
    visit(s);
    return;
  }
  for (const auto& half : s.halves()) forEachLeafBelow(mesh, half, enter, visit);
}

/// Calls visit(cell) for the cells of the base between two corners.
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

/// The mesh's leaves, or those that enter(simplex), asked on the way from the base, does not shut out.
template <int D, class Enter, class Visit>
void forEachLeaf(const Rbmt<D>& mesh, Enter enter, Visit visit) {
  Coordinates<D> end;
  for (int a = 0; a < D; ++a) end[a] = mesh.hierarchy().baseCells(a);
  forEachBaseCell<D>({}, end, [&](const Coordinates<D>& cell) {
    forEachBaseSimplex(mesh.hierarchy(), cell, [&](const auto& s) { forEachLeafBelow(mesh, s, enter, visit); });
  });
}
template <int D, class Visit>
void forEachLeaf(const Rbmt<D>& mesh, Visit visit) {
  forEachLeaf(
      mesh, [](const TaggedSimplex<D>&) { return true; }, visit);
}

/// The star of a vertex of the mesh: the leaves that have it.
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
  forEachBaseCell<D>(first, end, [&](const Coordinates<D>& cell) { forEachBaseSimplex(hierarchy, cell, look); });
}

/// May samples between two corners (inclusive, in the box) have both signs? No false "no"; asks a word a brick.
template <int D>
bool mayCross(const Signs<D>& signs, const typename Hierarchy<D>::Vertex& lowest,
              const typename Hierarchy<D>::Vertex& highest) {
  Coordinates<D> first, end;
  for (int a = 0; a < D; ++a) {
    first[a] = lowest[a] / kBrickSide;
    end[a] = highest[a] / kBrickSide + 1;
  }
  const uint32_t uniform = signs.index(signs.table().place(first));
  if (uniform > Signs<D>::kPositive) return true;
  for (auto brick = first;;) {
    if (signs.index(signs.table().place(brick)) != uniform) return true;
    int a = 0;
    for (; a < D && ++brick[a] == end[a]; ++a) brick[a] = first[a];
    if (a == D) return false;
  }
}
/// May samples of a simplex have both signs? Signs are those of the box's samples.
template <int D>
bool mayCross(const Signs<D>& signs, const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s) {
  return mayCross(signs, hierarchy.position(s.lowest()), hierarchy.position(s.highest()));
}

/// Has the simplex vertices of both signs?
template <int D>
bool crosses(const Signs<D>& signs, const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s) {
  const bool first = signs.at(hierarchy.position(s.vertices[0]));
  return std::any_of(s.vertices.begin() + 1, s.vertices.end(),
                     [&](const Coordinates<D>& v) { return signs.at(hierarchy.position(v)) != first; });
}

/// The tube (§3): leaves with vertices of both signs. Signs are those of the box's samples.
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
