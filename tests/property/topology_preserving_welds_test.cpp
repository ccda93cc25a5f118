// Welds that weldKeepsTopology() allows keep the topology of the isosurface (§4.3); others change
// it.
#include "bisection/adaptation.h"
#include "bisection/criteria.h"
#include "bisection/weld_topology.h"
#include "delicate_shapes.h"
#include "rbmt_checks.h"
#include "surface_invariants.h"

namespace isostar {
namespace {

template <class Dimension>
class TopologyPreservingWeldsTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(TopologyPreservingWeldsTest, Dimensions);

/// The signs of a field, by position.
template <int D>
struct Noise {
  const Hierarchy<D>* hierarchy;
  uint64_t seed;
  unsigned positiveOfEight = 4;
  bool operator()(const Coordinates<D>& v) const {
    uint64_t h = seed * 0x9E3779B97F4A7C15u;
    for (int32_t x : hierarchy->position(v)) {
      h = (h ^ static_cast<uint64_t>(x)) * 0xD6E8FEB86659FD93u;
      h ^= h >> 32;
    }
    return h % 8 < positiveOfEight;
  }
};

TYPED_TEST(TopologyPreservingWeldsTest, weldedNoiseKeepsItsInvariants) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    for (unsigned seed = 1; seed <= 12; ++seed) {
      const Noise<D> noise{&hierarchy, seed, 1 + seed % 4};
      auto mesh = Rbmt<D>::full(hierarchy);
      const auto before = invariantsOf(hierarchy, leavesOf(mesh), noise);
      coarsen(mesh,
              [&](const Diamond<D>& d) { return weldKeepsTopology(hierarchy, d.vertex, noise); });
      EXPECT_EQ(invariantsOf(hierarchy, leavesOf(mesh), noise), before)
          << "box " << box.last[0] << ' ' << box.last[1];
    }
  }
}

/// One weld changes the isosurface in a star only; the boundary of the star stays the same.
TYPED_TEST(TopologyPreservingWeldsTest, everyWeldKeepsItsStar) {
  constexpr int D = TypeParam::value;
  std::map<bool, int> answers;
  for (const auto& box : boxes<D>()) {
    const Hierarchy<D> hierarchy(box.last, box.finestLevel);
    std::mt19937 random(3);
    for (unsigned seed = 1; seed <= 150; ++seed) {
      const Noise<D> noise{&hierarchy, seed};
      const auto v = anyVertex(hierarchy, random);
      const auto d = hierarchy.diamond(v);
      std::vector<TaggedSimplex<D>> before, after;
      forEachSimplexOf(d, hierarchy, [&](const TaggedSimplex<D>& s) {
        after.push_back(s);
        for (const auto& half : s.halves()) {
          if (!hierarchy.flat(half.vertices)) before.push_back(half);
        }
      });
      const auto old = invariantsOf(hierarchy, before, noise),
                 now = invariantsOf(hierarchy, after, noise);
      const bool keeps = weldKeepsTopology(hierarchy, v, noise);
      ++answers[keeps];
      if (keeps) {
        EXPECT_EQ(old, now) << "vertex " << v[0] << ' ' << v[1] << ", box " << box.last[0] << ' '
                            << box.last[1];
      }
      // In three dimensions a refusal is correct, too, unless the box cuts the diamond before its
      // centre.
      bool cut = false;
      for (int a = 0; a < D; ++a) cut = cut || (d.along(a) && v[a] >= box.last[a]);
      if (D == 3 && !keeps && !cut) {
        EXPECT_NE(old, now) << "vertex " << v[0] << ' ' << v[1];
      }
    }
  }
  EXPECT_GT(answers[true], 100);
  EXPECT_GT(answers[false], 100);
}

struct Named {
  const char* name;
  SampledShape<3> shape;
  int64_t components, euler;
};

TEST(TopologyPreservingWelds, shapesKeepTheirTopologyWhileTheyCoarsen) {
  const Named shapes[] = {{"knot", knot(), 1, 0},
                          {"nested", nested(), 4, 8},
                          {"touching", touching(), 2, -2},
                          {"leaky box", leakyBox(), 1, 0}};
  for (const auto& [name, shape, components, euler] : shapes) {
    SCOPED_TRACE(name);
    const Hierarchy<3> hierarchy(shape.box, 3);
    auto positive = [&, &field = shape](const Coordinates<3>& v) {
      return field(hierarchy.position(v)) > 0;
    };
    Rbmt<3> finest(hierarchy);
    refine(finest, [&, &field = shape](const TaggedSimplex<3>& s) {
      return !mayCross(field.signs, hierarchy, s);
    });
    const auto tube = tubeOf(finest, shape.signs);
    const auto before = invariantsOf(hierarchy, tube, positive);
    EXPECT_EQ(before.components, components);
    EXPECT_EQ(before.euler, euler);

    auto careful = finest;
    coarsen(careful,
            [&](const Diamond<3>& d) { return weldKeepsTopology(hierarchy, d.vertex, positive); });
    const auto kept = tubeOf(careful, shape.signs);
    EXPECT_EQ(invariantsOf(hierarchy, kept, positive), before);
    EXPECT_LT(kept.size() * 3, tube.size()) << "the mesh is coarse";
    expectConformingAndRegular(careful);

    auto careless = finest;
    const DistanceBound<3, SampledShape<3>, SampledShape<3>> close(hierarchy, shape.signs, shape,
                                                                   shape, 2.5);
    coarsen(careless, allKept(hierarchy, close));
    EXPECT_NE(invariantsOf(hierarchy, tubeOf(careless, shape.signs), positive), before)
        << "the shape does not test anything";
  }
}

}  // namespace
}  // namespace isostar
