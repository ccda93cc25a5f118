#include "bisection/leaves.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

template <class Dimension>
class LeavesTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(LeavesTest, Dimensions);

template <int D, class Visit>
void forEachSample(const Coordinates<D>& lowest, const Coordinates<D>& highest, Visit visit) {
  for (auto v = lowest;;) {
    visit(v);
    int a = 0;
    for (; a < D && ++v[a] > highest[a]; ++a) v[a] = lowest[a];
    if (a == D) return;
  }
}

template <int D>
Signs<D> signsOf(const Coordinates<D>& box, const SignField<D>& field) {
  Signs<D> signs{Lattice<D>(box, 1)};
  forEachSample<D>({}, box, [&](const Coordinates<D>& v) { signs.set(v, field.positive(v)); });
  return signs;
}

template <int D>
Coordinates<D> someBox() {
  Coordinates<D> box;
  for (int a = 0; a < D; ++a) box[a] = D == 4 ? 5 + 2 * a : 17 - 3 * a;
  return box;
}

TYPED_TEST(LeavesTest, boxesCrossWhereTheirSamplesHaveBothSigns) {
  constexpr int D = TypeParam::value;
  const auto box = someBox<D>();
  for (const auto& field : signFields<D>(box)) {
    const auto signs = signsOf<D>(box, field);
    for (uint64_t seed = 1; seed <= 200; ++seed) {
      Coordinates<D> lowest, highest;
      for (int a = 0; a < D; ++a) {
        const auto hash = scrambled<D>(box, seed * 8 + static_cast<uint64_t>(a));
        lowest[a] = static_cast<int32_t>(hash % static_cast<uint64_t>(box[a] + 1));
        highest[a] = std::min(
            box[a], lowest[a] + static_cast<int32_t>((hash >> 32) % (seed % 2 == 0 ? 3 : 14)));
      }
      std::array<bool, 2> seen{};
      forEachSample<D>(lowest, highest,
                       [&](const Coordinates<D>& v) { seen[field.positive(v) ? 1 : 0] = true; });
      EXPECT_EQ(crossesBetween(signs, lowest, highest), seen[0] && seen[1])
          << field.name << ", seed " << seed;
    }
  }
}

TYPED_TEST(LeavesTest, theTubeIsAllCrossingLeaves) {
  constexpr int D = TypeParam::value;
  const auto box = someBox<D>();
  const Hierarchy<D> hierarchy(box, 2);
  for (const auto& field : signFields<D>(box)) {
    const auto signs = signsOf<D>(box, field);
    Rbmt<D> mesh(hierarchy);
    typename Rbmt<D>::Vertices added;
    for (const auto& v : {someBox<D>(), Coordinates<D>{1, 3}, Coordinates<D>{4, 2}})
      mesh.split(v, added);
    std::size_t tube = 0, crossing = 0;
    forEachCrossingLeaf(mesh, signs, [&](const TaggedSimplex<D>& leaf) {
      ++tube;
      EXPECT_TRUE(crosses(signs, hierarchy, leaf));
    });
    forEachLeaf(mesh,
                [&](const TaggedSimplex<D>& leaf) { crossing += crosses(signs, hierarchy, leaf); });
    EXPECT_EQ(tube, crossing) << field.name;
  }
}

}  // namespace
}  // namespace isostar
