// Checks of meshes of the RBMT (§4.2, §4.3) that do not use the closed form of its diamonds.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <vector>

#include "bisection/leaves.h"

namespace isostar {

template <int D>
using Points = std::set<Coordinates<D>>;

template <int D>
std::vector<TaggedSimplex<D>> leavesOf(const Rbmt<D>& mesh) {
  std::vector<TaggedSimplex<D>> leaves;
  forEachLeaf(mesh, [&](const TaggedSimplex<D>& s) { leaves.push_back(s); });
  return leaves;
}

template <int D>
Points<D> pointsOf(const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s) {
  Points<D> points;
  for (const auto& v : s.vertices) points.insert(hierarchy.position(v));
  return points;
}

/// D! times the volume, with the sign of its orientation.
template <int D>
int64_t volumeOf(const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s) {
  std::array<std::array<double, D>, D> m;
  const auto origin = hierarchy.position(s.vertices[0]);
  for (int i = 0; i < D; ++i) {
    const auto at = hierarchy.position(s.vertices[i + 1]);
    for (int a = 0; a < D; ++a) m[i][a] = at[a] - origin[a];
  }
  double determinant = 1;
  for (int i = 0; i < D; ++i) {
    int pivot = i;
    for (int j = i; j < D; ++j) pivot = std::abs(m[j][i]) > std::abs(m[pivot][i]) ? j : pivot;
    if (m[pivot][i] == 0) return 0;
    if (pivot != i) determinant = -determinant;
    std::swap(m[pivot], m[i]);
    determinant *= m[i][i];
    for (int j = i + 1; j < D; ++j) {
      const double factor = m[j][i] / m[i][i];
      for (int a = i; a < D; ++a) m[j][a] -= factor * m[i][a];
    }
  }
  return static_cast<int64_t>(std::lround(determinant));
}

/// Leaves fill the box once, meet face to face, and the depths of neighbours differ by one at most.
/// All by position: vertices beyond the box lie at its end.
template <int D>
void expectConformingAndRegular(const Rbmt<D>& mesh) {
  const auto& hierarchy = mesh.hierarchy();
  std::map<Points<D>, std::vector<int>> facets;
  int64_t volume = 0;
  for (const auto& leaf : leavesOf(mesh)) {
    const int64_t signedVolume = volumeOf(hierarchy, leaf);
    ASSERT_NE(signedVolume, 0);
    ASSERT_EQ(signedVolume < 0, leaf.mirrored);
    volume += std::abs(signedVolume);
    const auto points = pointsOf(hierarchy, leaf);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(D + 1));
    for (const auto& p : points) {
      auto facet = points;
      facet.erase(p);
      facets[facet].push_back(leaf.depth);
    }
  }
  int64_t whole = Simplex<D>::perCell();
  for (int32_t last : hierarchy.box()) whole *= last;
  EXPECT_EQ(volume, whole) << "the leaves fill the box";
  for (const auto& [facet, maxDepth] : facets) {
    bool boundary = false;
    for (int a = 0; a < D; ++a) {
      for (int32_t end : {0, hierarchy.box()[a]}) {
        boundary = boundary || std::all_of(facet.begin(), facet.end(),
                                           [&](const auto& p) { return p[a] == end; });
      }
    }
    ASSERT_EQ(maxDepth.size(), boundary ? 1u : 2u) << "leaves of a facet";
    ASSERT_LE(std::abs(maxDepth.front() - maxDepth.back()), 1) << "depths of neighbours";
  }
}

template <int D>
Points<D> verticesOf(const Rbmt<D>& mesh) {
  Points<D> vertices;
  for (int depth = 1; depth <= mesh.hierarchy().maxDepth(); ++depth) {
    mesh.forEachVertex(depth, [&](const Coordinates<D>& v) {
      EXPECT_EQ(mesh.hierarchy().diamond(v).depth, depth);
      EXPECT_TRUE(vertices.insert(v).second) << "visited twice";
    });
  }
  return vertices;
}

template <int D>
void expectClosed(const Rbmt<D>& mesh) {
  for (const auto& v : verticesOf(mesh)) {
    mesh.hierarchy().forEachParent(mesh.hierarchy().diamond(v),
                                   [&](const Coordinates<D>& p) { EXPECT_TRUE(mesh.contains(p)); });
  }
}

/// A random vertex that is not of the base and has simplices in the box.
template <int D>
Coordinates<D> anyVertex(const Hierarchy<D>& hierarchy, std::mt19937& dice) {
  const auto lattice = hierarchy.paddedLattice();
  for (;;) {
    Coordinates<D> v;
    const int shift = static_cast<int>(dice() % static_cast<unsigned>(hierarchy.finestLevel()));
    for (int a = 0; a < D; ++a)
      v[a] = static_cast<int32_t>(dice() % static_cast<unsigned>(lattice.last[a] + 1)) >>
             shift << shift;
    if (!hierarchy.isBase(v) && hierarchy.holds(v)) return v;
  }
}

template <int D>
struct Box {
  Coordinates<D> last;
  int finestLevel;
};
/// Boxes with whole and cut cells, thin ones, and ones smaller than a cell of the base.
template <int D>
std::vector<Box<D>> boxes() {
  if constexpr (D == 2)
    return {{{8, 8}, 3}, {{16, 8}, 2}, {{1, 13}, 2}, {{7, 5}, 3}, {{5, 11}, 2}, {{1, 1}, 2}};
  if constexpr (D == 3)
    return {{{4, 4, 4}, 2}, {{8, 4, 4}, 2}, {{6, 4, 8}, 2},
            {{1, 5, 2}, 2}, {{5, 3, 6}, 2}, {{3, 1, 1}, 3}};
  if constexpr (D == 4) return {{{2, 2, 2, 2}, 1}, {{3, 2, 1, 4}, 1}, {{4, 3, 2, 3}, 2}};
}

}  // namespace isostar
