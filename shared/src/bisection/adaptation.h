// Adapts a mesh of the RBMT to a criterion (§4.3): top down by splits, bottom up by welds.
#pragma once

#include "bisection/leaves.h"

namespace isostar {

// A criterion is a function `bool keeps(const TaggedSimplex<D>&)`: may the simplex be a leaf? It is
// called for simplices of any depth with vertices that the hierarchy holds, except the deepest
// ones, which every criterion must keep.

/// Splits until keeps() is true of every leaf. Calls it at most once for each simplex, and only
/// while the simplex is a leaf.
template <int D, class Keeps>
void refine(Rbmt<D>& mesh, Keeps keeps) {
  const auto& hierarchy = mesh.hierarchy();
  std::vector<TaggedSimplex<D>> open;
  typename Rbmt<D>::Vertices added;
  forEachLeaf(mesh, [&](const TaggedSimplex<D>& leaf) { open.push_back(leaf); });
  auto openAll = [&](const auto& simplices) {
    for (const auto& s : simplices) {
      if (s.depth < hierarchy.maxDepth() && !hierarchy.flat(s.vertices)) open.push_back(s);
    }
  };
  while (!open.empty()) {
    const auto s = open.back();
    open.pop_back();
    if (s.depth == hierarchy.maxDepth() || mesh.splits(s) || keeps(s)) continue;
    mesh.split(s.middle(), added);
    for (const auto& v : added) {
      forEachSimplexOf(hierarchy.diamond(v), hierarchy,
                       [&](const TaggedSimplex<D>& parent) { openAll(parent.halves()); });
    }
  }
}

/// Welds the diamonds for which allows(const Diamond<D>&) is true, deepest first, local welds only.
/// It is called once for each diamond that can be welded when its depth is processed, with the mesh
/// in its state at that moment. The weld follows at once.
template <int D, class Allows>
void coarsen(Rbmt<D>& mesh, Allows allows) {
  typename Rbmt<D>::Vertices removed;
  for (int depth = mesh.hierarchy().maxDepth(); depth >= 1; --depth) {
    mesh.forEachVertex(depth, [&](const Coordinates<D>& v) {
      if (mesh.canWeld(v) && allows(mesh.hierarchy().diamond(v))) mesh.weld(v, removed);
    });
  }
}

/// The function for coarsen() that follows from a criterion: does it keep all simplices that the
/// weld restores?
template <int D, class Keeps>
auto allKept(const Hierarchy<D>& hierarchy, Keeps keeps) {
  return [&hierarchy, keeps](const Diamond<D>& d) {
    bool all = true;
    forEachSimplexOf(d, hierarchy, [&](const TaggedSimplex<D>& s) { all = all && keeps(s); });
    return all;
  };
}

}  // namespace isostar
