#include "bisection/tagged_simplex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace isostar {
namespace {

template <int D>
std::vector<TaggedSimplex<D>> baseOf(const Hierarchy<D>& hierarchy) {
  std::vector<TaggedSimplex<D>> all;
  forEachBaseSimplex(hierarchy, Coordinates<D>{}, [&](const auto& s) { all.push_back(s); });
  return all;
}

/// D! times the volume of a simplex, with the sign of its orientation.
template <int D>
int64_t orientedVolume(const TaggedSimplex<D>& s) {
  std::array<std::array<double, D>, D> m;
  for (std::size_t i = 0; i < D; ++i) {
    for (std::size_t a = 0; a < D; ++a) m[i][a] = s.vertices[i + 1][a] - s.vertices[0][a];
  }
  double determinant = 1;
  for (std::size_t i = 0; i < D; ++i) {
    std::size_t pivot = i;
    while (pivot < D && m[pivot][i] == 0) ++pivot;
    if (pivot == D) return 0;
    if (pivot != i) {
      std::swap(m[pivot], m[i]);
      determinant = -determinant;
    }
    determinant *= m[i][i];
    for (std::size_t j = i + 1; j < D; ++j) {
      const double factor = m[j][i] / m[i][i];
      for (std::size_t a = i; a < D; ++a) m[j][a] -= factor * m[i][a];
    }
  }
  return std::llround(determinant);
}

template <int D>
void expectBisection(int finestLevel) {
  Coordinates<D> box;
  box.fill(1 << finestLevel);
  const Hierarchy<D> hierarchy(box, finestLevel);
  auto all = baseOf(hierarchy);
  std::size_t count = 1;
  for (int i = 2; i <= D; ++i) count *= static_cast<std::size_t>(i);
  ASSERT_EQ(all.size(), count);
  for (int depth = 0; depth < hierarchy.maxDepth(); ++depth, count *= 2) {
    std::vector<TaggedSimplex<D>> finer;
    for (const auto& s : all) {
      const int64_t volume = orientedVolume(s);
      EXPECT_EQ(volume < 0, s.mirrored);
      EXPECT_EQ(s.depth, depth);
      EXPECT_EQ(hierarchy.diamond(s.middle()).depth, depth + 1);
      for (const auto& half : s.halves()) {
        EXPECT_EQ(2 * std::abs(orientedVolume(half)), std::abs(volume));
        EXPECT_TRUE(half.has(s.middle()));
        finer.push_back(half);
      }
    }
    all = std::move(finer);
  }
  EXPECT_EQ(all.size(), count);
}

TEST(TaggedSimplex, isBisectedIntoHalves) {
  expectBisection<2>(3);
  expectBisection<3>(2);
  expectBisection<4>(1);
}

TEST(TaggedSimplex, hasTheBoundsOfItsVertices) {
  for (const auto& s : baseOf(Hierarchy<3>({4, 4, 4}, 2))) {
    EXPECT_EQ(s.lowest(), (Coordinates<3>{0, 0, 0}));
    EXPECT_EQ(s.highest(), (Coordinates<3>{4, 4, 4}));
    const auto half = s.halves()[0];
    EXPECT_TRUE(half.has({2, 2, 2}));
    EXPECT_FALSE(half.has(s.vertices[3]));
  }
}

TEST(TaggedSimplex, diamondsHaveTheSimplicesOfTheirEdge) {
  const Hierarchy<3> hierarchy({8, 8, 8}, 2);
  for (const auto& [vertex, expected] : {std::pair{Coordinates<3>{2, 2, 2}, std::size_t{6}},
                                         {{2, 2, 4}, 4},
                                         {{2, 2, 0}, 2},
                                         {{4, 4, 2}, 8}}) {
    const auto diamond = hierarchy.diamond(vertex);
    EXPECT_EQ(diamond.vertex, vertex);
    std::set<std::set<Coordinates<3>>> found;
    forEachSimplexOf(diamond, hierarchy, [&](const TaggedSimplex<3>& s) {
      EXPECT_EQ(s.middle(), diamond.vertex);
      EXPECT_EQ(s.depth, diamond.depth - 1);
      EXPECT_EQ(orientedVolume(s) < 0, s.mirrored);
      found.insert({s.vertices.begin(), s.vertices.end()});
    });
    EXPECT_EQ(found.size(), expected) << testing::PrintToString(vertex);
  }
}

}  // namespace
}  // namespace isostar
