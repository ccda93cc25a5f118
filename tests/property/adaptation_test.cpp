// A mesh adapted to a criterion meets it, is conforming and no finer than it must be (§4.3).
#include "bisection/adaptation.h"

#include "bisection/criteria.h"
#include "rbmt_checks.h"
#include "sampled_shapes.h"

namespace isostar {
namespace {

template <class Dimension>
class AdaptationTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AdaptationTest, Dimensions);

/// An arbitrary criterion: a hash of the simplex decides.
template <int D>
struct HashCriterion {
  unsigned seed;
  unsigned splitsOfSixteen;
  bool operator()(const TaggedSimplex<D>& s) const {
    uint64_t h = seed;
    for (const auto& v : s.vertices) {
      for (int32_t x : v) h = (h ^ static_cast<uint64_t>(x)) * 0xD6E8FEB86659FD93u + (h >> 32);
    }
    return (h >> 40) % 16 >= splitsOfSixteen;
  }
};

template <int D, class Keeps>
void expectKept(const Rbmt<D>& mesh, const Keeps& keeps) {
  for (const auto& leaf : leavesOf(mesh))
    EXPECT_TRUE(leaf.depth == mesh.hierarchy().maxDepth() || keeps(leaf));
}

TYPED_TEST(AdaptationTest, refinedMeshesMeetAnyCriterion) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const HashCriterion<D> criterion{seed, 3 * seed};
      Rbmt<D> mesh(Hierarchy<D>(box.last, box.finestLevel));
      refine(mesh, criterion);
      expectKept(mesh, criterion);
      expectConformingAndRegular(mesh);
      expectClosed(mesh);
    }
  }
}

TYPED_TEST(AdaptationTest, refiningTwiceAddsNothing) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const HashCriterion<D> criterion{5, 8};
    Rbmt<D> mesh(Hierarchy<D>(box.last, box.finestLevel));
    refine(mesh, criterion);
    const auto once = verticesOf(mesh);
    refine(mesh, criterion);
    EXPECT_TRUE(verticesOf(mesh) == once);
  }
}

TYPED_TEST(AdaptationTest, coarsenedMeshesMeetAnyCriterion) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const HashCriterion<D> criterion{seed, seed};
      const Hierarchy<D> hierarchy(box.last, box.finestLevel);
      auto mesh = Rbmt<D>::full(hierarchy);
      const auto allows = allKept(hierarchy, criterion);
      coarsen(mesh, allows);
      expectKept(mesh, criterion);
      expectConformingAndRegular(mesh);
      expectClosed(mesh);
      for (const auto& v : verticesOf(mesh))
        EXPECT_FALSE(mesh.canWeld(v) && allows(hierarchy.diamond(v))) << "one more could be welded";
    }
  }
}

TYPED_TEST(AdaptationTest, extremeCriteriaGiveTheBaseAndTheFullMesh) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    const auto all = verticesOf(Rbmt<D>::full(hierarchy));
    Rbmt<D> mesh(hierarchy);
    refine(mesh, [](const auto&) { return true; });
    EXPECT_TRUE(verticesOf(mesh).empty());
    refine(mesh, [](const auto&) { return false; });
    EXPECT_TRUE(verticesOf(mesh) == all);
    coarsen(mesh, [](const auto&) { return false; });
    EXPECT_TRUE(verticesOf(mesh) == all);
    coarsen(mesh, [](const auto&) { return true; });
    EXPECT_TRUE(verticesOf(mesh).empty());
  }
}

/// A mesh that is fully refined at the surface is welded within a distance.
TYPED_TEST(AdaptationTest, theDistanceBoundHoldsAndRemovesVertices) {
  constexpr int D = TypeParam::value;
  const auto ball = sampledBall<D>(D == 4 ? 8 : 29);
  const Hierarchy<D> hierarchy(ball.box, D == 4 ? 2 : 4);
  Rbmt<D> mesh(hierarchy);
  refine(mesh, [&](const TaggedSimplex<D>& s) { return !mayCross(ball.signs, hierarchy, s); });
  const auto tube = tubeOf(mesh, ball.signs);
  for (const auto& leaf : tube) EXPECT_EQ(leaf.depth, hierarchy.maxDepth());
  const double bound = 0.2;
  const DistanceBound<D, SampledShape<D>, SampledShape<D>> keeps(hierarchy, ball.signs, ball, ball,
                                                                 bound);
  coarsen(mesh, allKept(hierarchy, keeps));
  expectKept(mesh, keeps);
  expectConformingAndRegular(mesh);
  const auto coarse = tubeOf(mesh, ball.signs);
  EXPECT_LT(coarse.size() * 2, tube.size());
  for (const auto& leaf : coarse) {
    for (const auto& p : crossingsOf(hierarchy, leaf, ball))
      EXPECT_LT(std::abs(ball.at(p)), 1.5 * bound);
  }
}

TYPED_TEST(AdaptationTest, aPlaneNeedsNoVertices) {
  constexpr int D = TypeParam::value;
  const auto plane = sampledPlane<D>(D == 4 ? 7 : 13);
  const Hierarchy<D> hierarchy(plane.box, D == 4 ? 2 : 3);
  const DistanceBound<D, SampledShape<D>, SampledShape<D>> keeps(hierarchy, plane.signs, plane,
                                                                 plane, 1e-4);
  auto mesh = Rbmt<D>::full(hierarchy);
  coarsen(mesh, allKept(hierarchy, keeps));
  EXPECT_TRUE(verticesOf(mesh).empty()) << "a plane is exact on any mesh";
}

/// Samples on the wrong side of a coarse leaf's linear function are farther away than the bound:
/// the leaf must be refused.
TEST(Adaptation, theDistanceBoundCountsSamplesBetweenVertices) {
  auto speck = sampledPlane<2>(16);
  for (auto& value : speck.values) value = -1;
  speck.values[speck.index({5, 11})] = 1;
  speck.updateSigns();
  const Hierarchy<2> hierarchy(speck.box, 4);
  const DistanceBound<2, SampledShape<2>, SampledShape<2>> keeps(hierarchy, speck.signs, speck,
                                                                 speck, 0.25);
  auto mesh = Rbmt<2>::full(hierarchy);
  coarsen(mesh, allKept(hierarchy, keeps));
  EXPECT_TRUE(mesh.contains({5, 11}));
  EXPECT_LT(verticesOf(mesh).size(), 60u) << "far from the surface the mesh is coarse";
}

TYPED_TEST(AdaptationTest, normalsRefineWhereTheSurfaceBends) {
  constexpr int D = TypeParam::value;
  const auto ball = sampledBall<D>(D == 4 ? 8 : 16);
  const Hierarchy<D> hierarchy(ball.box, D == 4 ? 3 : 4);
  std::size_t before = 0;
  for (double degrees : {60.0, 25.0, 10.0}) {
    const NormalBound<D, SampledShape<D>, SampledShape<D>> keeps(hierarchy, ball.signs, ball, ball,
                                                                 degrees * std::acos(-1.0) / 180);
    Rbmt<D> mesh(hierarchy);
    refine(mesh, keeps);
    expectKept(mesh, keeps);
    const auto size = verticesOf(mesh).size();
    EXPECT_GT(size, before);
    before = size;
  }
  const auto plane = sampledPlane<D>(D == 4 ? 8 : 16);
  Rbmt<D> mesh(Hierarchy<D>(plane.box, D == 4 ? 2 : 3));
  refine(mesh, NormalBound<D, SampledShape<D>, SampledShape<D>>(mesh.hierarchy(), plane.signs,
                                                                plane, plane, 1e-3));
  EXPECT_TRUE(verticesOf(mesh).empty());
}

}  // namespace
}  // namespace isostar
