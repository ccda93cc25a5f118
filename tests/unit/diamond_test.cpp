#include "bisection/diamond.h"

#include <gtest/gtest.h>

#include <set>

#include "dense_signs.h"

namespace isostar {
namespace {

TEST(Diamond, ofACentreAFaceAndAnEdgeInThreeDimensions) {
  const Hierarchy<3> hierarchy({8, 8, 8}, 2);
  const auto centre = hierarchy.diamond({2, 2, 6});
  EXPECT_EQ(centre.half, 2);
  EXPECT_EQ(centre.axes(), 3);
  EXPECT_EQ(centre.depth, 1);
  EXPECT_EQ(centre.evenEnd(), (Coordinates<3>{0, 0, 8})) << "cells mirror each other";
  EXPECT_EQ(centre.oddEnd(), (Coordinates<3>{4, 4, 4}));
  const auto face = hierarchy.diamond({2, 2, 4});
  EXPECT_EQ(face.newAxes, 3u);
  EXPECT_EQ(face.depth, 2);
  const auto edge = hierarchy.diamond({4, 1, 2});
  EXPECT_EQ(edge.half, 1);
  EXPECT_EQ(edge.newAxes, 2u);
  EXPECT_EQ(edge.depth, 6);
  EXPECT_EQ(edge.evenEnd(), (Coordinates<3>{4, 0, 2}));
  EXPECT_EQ(edge.oddEnd(), (Coordinates<3>{4, 2, 2}));
}

TEST(Hierarchy, knowsTheVerticesOfTheBase) {
  const Hierarchy<2> hierarchy({9, 8}, 3);
  EXPECT_EQ(hierarchy.baseStep(), 8);
  EXPECT_EQ(hierarchy.baseCells(0), 2);
  EXPECT_EQ(hierarchy.baseCells(1), 1);
  EXPECT_TRUE(hierarchy.isBase({16, 8}));
  EXPECT_FALSE(hierarchy.isBase({16, 4}));
  EXPECT_EQ(hierarchy.position({16, 8}), (Coordinates<2>{9, 8}));
  EXPECT_TRUE(hierarchy.flat(std::array<Coordinates<2>, 3>{{{9, 0}, {16, 0}, {16, 8}}}));
  EXPECT_FALSE(hierarchy.flat(std::array<Coordinates<2>, 3>{{{8, 0}, {16, 0}, {16, 8}}}));
}

/// For every vertex: ends lie symmetrically, parents are one depth above and children one below,
/// and both relations are inverse to each other.
template <int D>
void expectConsistent(const Coordinates<D>& box, int finestLevel) {
  const Hierarchy<D> hierarchy(box, finestLevel);
  using Vertex = Coordinates<D>;
  std::set<std::pair<Vertex, Vertex>> byParents, byChildren;
  forVertices(hierarchy.paddedLattice(), [&](const Vertex& v) {
    if (hierarchy.isBase(v) || !hierarchy.holds(v)) return;
    const auto diamond = hierarchy.diamond(v);
    const auto even = diamond.evenEnd(), odd = diamond.oddEnd();
    for (int a = 0; a < D; ++a) EXPECT_EQ(even[a] + odd[a], 2 * v[a]);
    hierarchy.forEachParent(diamond, [&](const Vertex& parent) {
      if (hierarchy.isBase(parent)) return;
      EXPECT_EQ(hierarchy.diamond(parent).depth, diamond.depth - 1);
      byParents.emplace(parent, v);
    });
    hierarchy.forEachChild(diamond, [&](const Vertex& child) {
      EXPECT_EQ(hierarchy.diamond(child).depth, diamond.depth + 1);
      byChildren.emplace(v, child);
    });
  });
  EXPECT_EQ(byParents, byChildren);
}

TEST(Hierarchy, parentsAndChildrenAreInverse) {
  expectConsistent<2>({16, 8}, 3);
  expectConsistent<3>({8, 8, 4}, 2);
  expectConsistent<4>({4, 4, 4, 4}, 2);
}

}  // namespace
}  // namespace isostar
