// Neighbours and parents in closed form are those that bisection creates (§4.3).
#include "bisection/adjacency.h"

#include "../property/rbmt_checks.h"

namespace isostar {
namespace {

template <class Dimension>
class AdjacencyTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AdjacencyTest, Dimensions);

/// All simplices of one depth that are in the box.
template <int D>
std::vector<TaggedSimplex<D>> simplicesOf(const Hierarchy<D>& hierarchy, int depth) {
  auto all = leavesOf(Rbmt<D>(hierarchy));
  for (int i = 0; i < depth; ++i) {
    std::vector<TaggedSimplex<D>> finer;
    for (const auto& s : all) {
      for (const auto& half : s.halves()) {
        if (!hierarchy.flat(half.vertices)) finer.push_back(half);
      }
    }
    all = std::move(finer);
  }
  return all;
}

template <int D>
void expectSame(const TaggedSimplex<D>& a, const TaggedSimplex<D>& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.tag, b.tag);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.mirrored, b.mirrored);
}

TYPED_TEST(AdjacencyTest, parentIsTheBisectedSimplex) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    for (int depth = 0; depth < hierarchy.maxDepth(); ++depth) {
      for (const auto& s : simplicesOf(hierarchy, depth)) {
        for (const auto& half : s.halves()) {
          expectSame(parent(half), s);
          EXPECT_EQ(half.vertices[newest(half)], s.middle());
        }
      }
    }
  }
}

TYPED_TEST(AdjacencyTest, acrossEachFaceIsTheSimplexThatSharesIt) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    for (int depth = 0; depth <= hierarchy.maxDepth(); ++depth) {
      std::map<Points<D>, std::vector<TaggedSimplex<D>>> byFace;
      const auto faceOf = [](const TaggedSimplex<D>& s, int i) {
        Points<D> face(s.vertices.begin(), s.vertices.end());
        face.erase(s.vertices[i]);
        return face;
      };
      const auto all = simplicesOf(hierarchy, depth);
      for (const auto& s : all) {
        for (int i = 0; i <= D; ++i) byFace[faceOf(s, i)].push_back(s);
      }
      for (const auto& s : all) {
        for (int i = 0; i <= D; ++i) {
          const auto& both = byFace[faceOf(s, i)];
          const auto other = across(hierarchy, s, i);
          ASSERT_EQ(other.has_value(), both.size() == 2);
          if (!other) continue;
          expectSame(other->simplex, both[both[0].vertices == s.vertices ? 1 : 0]);
          EXPECT_FALSE(s.has(other->simplex.vertices[other->newVertex]));
        }
      }
    }
  }
}

}  // namespace
}  // namespace isostar
