// Adapting a mesh of the RBMT to a criterion (§4.3): top down by splits, bottom up by welds.
#pragma once

#include "bisection/leaves.h"

namespace isostar {

// A criterion is a function `bool keeps(const TaggedSimplex<D>&)`: may the simplex be a leaf? It is
// asked of simplices with vertices of the hierarchy, of any level but the finest, whose simplices
// every criterion keeps.

/// Splits until keeps() keeps every leaf. Each simplex is asked at most once, and only while it is
/// a leaf.
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

/// Welds what allows(const Diamond<D>&) allows, finest level first, local welds only: it is asked
/// once of each diamond that can be welded when its level's turn comes, of the mesh as it then is.
/// Welds it does right after a "yes".
template <int D, class Allows>
void coarsen(Rbmt<D>& mesh, Allows allows) {
  typename Rbmt<D>::Vertices removed;
  for (int depth = mesh.hierarchy().maxDepth(); depth >= 1; --depth) {
    mesh.forEachVertex(depth, [&](const Coordinates<D>& v) {
      if (mesh.canWeld(v) && allows(mesh.hierarchy().diamond(v))) mesh.weld(v, removed);
    });
  }
}

/// What coarsen() asks where a criterion decides: are all simplices that the weld brings back kept?
template <int D, class Keeps>
auto allKept(const Hierarchy<D>& hierarchy, Keeps keeps) {
  return [&hierarchy, keeps](const Diamond<D>& d) {
    bool all = true;
    forEachSimplexOf(d, hierarchy, [&](const TaggedSimplex<D>& s) { all = all && keeps(s); });
    return all;
  };
}

}  // namespace isostar
