#include "grid/refined_signs.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

template <int D>
void expectRefined(const Coordinates<D>& box) {
  SCOPED_TRACE(testing::PrintToString(box));
  for (int32_t step : {2, 4, 8}) {
    for (const auto& field : signFields<D>(box)) {
      const DenseSigns<D> coarse(Lattice<D>(box, step), field.positive);
      const auto fine = refined(coarse.bricks());
      ASSERT_EQ(fine.lattice().step, step / 2);
      forVertices(fine.lattice(), [&](const Coordinates<D>& v) {
        Coordinates<D> parent;
        for (int a = 0; a < D; ++a) parent[a] = fine.lattice().parent(a, v[a]);
        EXPECT_EQ(fine.at(v), coarse.at(parent))
            << field.name << " at " << testing::PrintToString(v) << ", step " << step;
      });
    }
  }
}

TEST(RefinedSigns, haveTheSignsOfTheirParents) {
  for (int32_t last = 0; last < 40; ++last)
    expectRefined<2>({last, 37 - last > 0 ? 37 - last : last});
  expectRefined<3>({16, 33, 5});
  expectRefined<3>({7, 7, 7});
  expectRefined<3>({0, 21, 1});
  expectRefined<3>({30, 31, 32});
  expectRefined<4>({9, 4, 17, 3});
}

/// Does the brick hold both signs, or touch a vertex of a sign that it lacks? Vertices count as
/// bricks store them, also beyond the lattice.
template <int D>
bool activeByForce(const Signs<D>& signs, const Coordinates<D>& brick) {
  bool positive = false, negative = false;
  Coordinates<D> d;
  d.fill(-1);
  for (std::size_t n = 0; n < power(kBrickSide + 2, D); ++n) {
    Coordinates<D> v;
    bool stored = true;
    for (int a = 0; a < D; ++a) {
      v[a] = brick[a] * kBrickSide + d[a];
      stored = stored && v[a] >= 0 && v[a] < signs.table().count(a) * kBrickSide;
    }
    if (stored) (signs.at(v) ? positive : negative) = true;
    for (int a = 0; a < D && ++d[a] == kBrickSide + 1; ++a) d[a] = -1;
  }
  return positive && negative;
}

template <int D>
void expectActive(const Coordinates<D>& box) {
  SCOPED_TRACE(testing::PrintToString(box));
  for (const auto& field : signFields<D>(box)) {
    // Beyond the lattice signs repeat, as in a GridField.
    Coordinates<D> whole;
    for (int a = 0; a < D; ++a) whole[a] = box[a] | (kBrickSide - 1);
    Signs<D> signs{Lattice<D>(box, 1)};
    forVertices(Lattice<D>(whole, 1), [&](Coordinates<D> v) {
      auto inside = v;
      for (int a = 0; a < D; ++a) inside[a] = std::min(v[a], box[a]);
      signs.set(v, field.positive(inside));
    });
    Signs<D> shared(signs.lattice());
    for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex)
      shared.put(brickIndex, signs.brickAt(brickIndex));
    const auto active = activeBricks(shared);
    ASSERT_EQ(active.size(), shared.table().total());
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex) {
      EXPECT_EQ(active[brickIndex] != 0, activeByForce<D>(shared, shared.table().brick(brickIndex)))
          << field.name << ", brick " << brickIndex;
      EXPECT_LE(active[brickIndex], 1);
    }
  }
}

TEST(ActiveBricks, areThoseAtTheSurface) {
  expectActive<2>({70, 70});
  expectActive<2>({7, 40});
  expectActive<2>({8, 41});
  expectActive<2>({0, 64});
  expectActive<3>({31, 31, 31});
  expectActive<3>({32, 9, 40});
  expectActive<3>({7, 7, 7});
  expectActive<3>({0, 0, 0});
  expectActive<4>({15, 8, 16, 7});
}

TEST(ActiveBricks, areFoundBesideEachPairOfUniformBricks) {
  // Two positive bricks at each offset from each other; all others are negative.
  const Lattice<2> lattice({47, 47}, 1);
  for (std::size_t a = 0; a < 36; ++a) {
    for (std::size_t b = 0; b < 36; ++b) {
      Signs<2> signs(lattice);
      signs.setUniform(a, Signs<2>::kPositive);
      signs.setUniform(b, Signs<2>::kPositive);
      const auto active = activeBricks(signs);
      for (std::size_t brickIndex = 0; brickIndex < 36; ++brickIndex)
        ASSERT_EQ(active[brickIndex] != 0, activeByForce<2>(signs, signs.table().brick(brickIndex)))
            << a << ' ' << b;
    }
  }
}

}  // namespace
}  // namespace isostar
