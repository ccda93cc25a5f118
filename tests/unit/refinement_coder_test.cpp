#include "coding/signs/refinement_coder.h"

#include <gtest/gtest.h>

#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

template <int D>
std::vector<Coordinates<D>> boxes() {
  if constexpr (D == 2) return {{1, 1}, {2, 5}, {7, 8}, {16, 17}, {31, 9}, {40, 33}, {1, 30}};
  if constexpr (D == 3)
    return {{1, 1, 1}, {2, 2, 2}, {5, 7, 3}, {8, 15, 16}, {17, 9, 25}, {1, 12, 33}};
  if constexpr (D == 4) return {{1, 1, 1, 1}, {2, 3, 4, 5}, {9, 4, 3, 2}};
}

template <class Dimension>
class RefinementCoderTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(RefinementCoderTest, Dimensions);

/// One side of the hierarchy.
template <int D>
struct Side {
  Signs<D> signs;
  std::unique_ptr<RefinementCoder<D>> coder = std::make_unique<RefinementCoder<D>>();

  template <class Exchange>
  void refine(Exchange& exchange) {
    signs = refined(signs);
    coder->code(exchange, signs);
  }
};

TYPED_TEST(RefinementCoderTest, eachOctaveIsTheSources) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (const auto& field : signFields<D>(box)) {
      SCOPED_TRACE(field.name + " in " + testing::PrintToString(box));
      int32_t step = 8;
      Side<D> mine{DenseSigns<D>(Lattice<D>(box, step), field.positive).bricks()};
      Side<D> theirs{mine.signs};
      while (step > 1) {
        step /= 2;
        const DenseSigns<D> actual(Lattice<D>(box, step), field.positive);
        const auto bytes =
            coded(actual.bricks(), NoScalars(), [&](auto& exchange) { mine.refine(exchange); });
        ASSERT_TRUE(decoded<D>(bytes, [&](auto& exchange) { theirs.refine(exchange); }));
        ASSERT_EQ(DenseSigns<D>(mine.signs), actual) << "step " << step;
        ASSERT_EQ(DenseSigns<D>(theirs.signs), actual) << "step " << step;
      }
    }
  }
}

TYPED_TEST(RefinementCoderTest, randomAnswersAreAlwaysSomeSurface) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (uint64_t seed = 0; seed < 8; ++seed) {
      const double rate = std::array{0.5, 0.02, 0.98, 1.0}[seed % 4];
      Side<D> mine{DenseSigns<D>(Lattice<D>(box, 4), signFields<D>(box)[seed].positive).bricks()};
      Side<D> theirs{mine.signs};
      for (int level = 0; level < 2; ++level) {
        const auto bytes = thrown<D>(seed, rate, [&](auto& exchange) { mine.refine(exchange); });
        ASSERT_TRUE(decoded<D>(bytes, [&](auto& exchange) { theirs.refine(exchange); }));
        ASSERT_EQ(DenseSigns<D>(theirs.signs), DenseSigns<D>(mine.signs)) << "seed " << seed;
      }
    }
  }
}

TYPED_TEST(RefinementCoderTest, aSettledSignNeverMoves) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    Side<D> side{DenseSigns<D>(Lattice<D>(box, 2), signFields<D>(box)[0].positive).bricks()};
    const DenseSigns<D> before(side.signs);
    (void)thrown<D>(1, 0.5, [&](auto& exchange) { side.refine(exchange); });
    forVertices(side.signs.lattice(), [&](const Coordinates<D>& v) {
      Coordinates<D> parent;
      bool settled = true;
      for (int a = 0; a < D; ++a) {
        parent[a] = side.signs.lattice().parent(a, v[a]);
        settled = settled && !side.signs.lattice().isNew(a, v[a]);
      }
      EXPECT_TRUE(!settled || side.signs.at(v) == before.at(parent)) << testing::PrintToString(v);
    });
  }
}

TEST(RefinementCoder, aUniformOctaveCostsNearlyNothing) {
  const Coordinates<3> box{255, 255, 255};
  const Signs<3> uniform{Lattice<3>(box, 1)};
  Side<3> side{Signs<3>(Lattice<3>(box, 2))};
  EXPECT_LE(coded(uniform, NoScalars(), [&](auto& exchange) { side.refine(exchange); }).size(),
            30u);
}

TEST(RefinementCoder, componentsFarFromTheSurfaceAreFound) {
  // Single vertices of each class, in bricks without a surface, over one with.
  const Coordinates<3> box{63, 63, 63};
  auto field = [](const Coordinates<3>& v) {
    if (v[2] < 4) return true;
    return v == Coordinates<3>{33, 33, 33} || v == Coordinates<3>{51, 19, 40} ||
           v == Coordinates<3>{62, 63, 63} || v == Coordinates<3>{9, 56, 32};
  };
  const DenseSigns<3> actual(Lattice<3>(box, 1), field);
  Side<3> mine{DenseSigns<3>(Lattice<3>(box, 2), field).bricks()};
  Side<3> theirs{mine.signs};
  const auto bytes =
      coded(actual.bricks(), NoScalars(), [&](auto& exchange) { mine.refine(exchange); });
  ASSERT_TRUE(decoded<3>(bytes, [&](auto& exchange) { theirs.refine(exchange); }));
  EXPECT_EQ(DenseSigns<3>(theirs.signs), actual);
}

}  // namespace
}  // namespace isostar
