#include "bisection/leaf_set.h"

#include <gtest/gtest.h>

#include "bisection/leaves.h"

namespace isostar {
namespace {

TEST(LeafSet, holdsTheLeavesOfAMesh) {
  const auto mesh = Rbmt<3>::full(Hierarchy<3>({8, 6, 5}, 3));
  LeafSet<3> leaves;
  std::size_t count = 0;
  forEachLeaf(mesh, [&](const TaggedSimplex<3>& leaf) {
    EXPECT_FALSE(leaves.has(leaf));
    EXPECT_TRUE(leaves.insert(leaf));
    EXPECT_FALSE(leaves.insert(leaf)) << "it is there already";
    EXPECT_EQ(leaves.size(), ++count);
  });
  EXPECT_GT(count, 1000u);
  forEachLeaf(mesh, [&](const TaggedSimplex<3>& leaf) { EXPECT_TRUE(leaves.has(leaf)); });
}

TEST(LeafSet, identifiesLeavesByTheirVerticesInAnyOrder) {
  LeafSet<2> leaves;
  TaggedSimplex<2> leaf;
  leaf.vertices = {{{0, 0}, {2, 0}, {2, 2}}};
  EXPECT_FALSE(leaves.has(leaf));
  leaves.insert(leaf);
  std::swap(leaf.vertices[0], leaf.vertices[2]);
  EXPECT_TRUE(leaves.has(leaf));
  leaf.vertices[1] = {0, 2};
  EXPECT_FALSE(leaves.has(leaf));
}

}  // namespace
}  // namespace isostar
