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

/// The state of the encoder or of the decoder.
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

TYPED_TEST(RefinementCoderTest, decodesTheSignsOfEachLevel) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (const auto& field : signFields<D>(box)) {
      SCOPED_TRACE(field.name + " in " + testing::PrintToString(box));
      int32_t step = 8;
      Side<D> encoder{DenseSigns<D>(Lattice<D>(box, step), field.positive).bricks()};
      Side<D> decoder{encoder.signs};
      while (step > 1) {
        step /= 2;
        const DenseSigns<D> actual(Lattice<D>(box, step), field.positive);
        const auto bytes =
            coded(actual.bricks(), NoScalars(), [&](auto& exchange) { encoder.refine(exchange); });
        ASSERT_TRUE(decoded<D>(bytes, [&](auto& exchange) { decoder.refine(exchange); }));
        ASSERT_EQ(DenseSigns<D>(encoder.signs), actual) << "step " << step;
        ASSERT_EQ(DenseSigns<D>(decoder.signs), actual) << "step " << step;
      }
    }
  }
}

TYPED_TEST(RefinementCoderTest, randomDecisionsDecodeToTheSameSigns) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    for (uint64_t seed = 0; seed < 8; ++seed) {
      const double rate = std::array{0.5, 0.02, 0.98, 1.0}[seed % 4];
      Side<D> encoder{
          DenseSigns<D>(Lattice<D>(box, 4), signFields<D>(box)[seed].positive).bricks()};
      Side<D> decoder{encoder.signs};
      for (int level = 0; level < 2; ++level) {
        const auto bytes =
            randomlyCoded<D>(seed, rate, [&](auto& exchange) { encoder.refine(exchange); });
        ASSERT_TRUE(decoded<D>(bytes, [&](auto& exchange) { decoder.refine(exchange); }));
        ASSERT_EQ(DenseSigns<D>(decoder.signs), DenseSigns<D>(encoder.signs)) << "seed " << seed;
      }
    }
  }
}

TYPED_TEST(RefinementCoderTest, signsOfTheCoarserLevelNeverChange) {
  constexpr int D = TypeParam::value;
  for (const auto& box : boxes<D>()) {
    Side<D> side{DenseSigns<D>(Lattice<D>(box, 2), signFields<D>(box)[0].positive).bricks()};
    const DenseSigns<D> before(side.signs);
    (void)randomlyCoded<D>(1, 0.5, [&](auto& exchange) { side.refine(exchange); });
    forVertices(side.signs.lattice(), [&](const Coordinates<D>& v) {
      Coordinates<D> parent;
      bool isOld = true;
      for (int a = 0; a < D; ++a) {
        parent[a] = side.signs.lattice().parent(a, v[a]);
        isOld = isOld && !side.signs.lattice().isNew(a, v[a]);
      }
      EXPECT_TRUE(!isOld || side.signs.at(v) == before.at(parent)) << testing::PrintToString(v);
    });
  }
}

TEST(RefinementCoder, aUniformLevelCostsNearlyNothing) {
  const Coordinates<3> box{255, 255, 255};
  const Signs<3> uniform{Lattice<3>(box, 1)};
  Side<3> side{Signs<3>(Lattice<3>(box, 2))};
  EXPECT_LE(coded(uniform, NoScalars(), [&](auto& exchange) { side.refine(exchange); }).size(),
            30u);
}

TEST(RefinementCoder, newComponentsFarFromTheSurfaceAreFound) {
  // Single vertices of each class in bricks without a surface, and one brick layer with one.
  const Coordinates<3> box{63, 63, 63};
  auto field = [](const Coordinates<3>& v) {
    if (v[2] < 4) return true;
    return v == Coordinates<3>{33, 33, 33} || v == Coordinates<3>{51, 19, 40} ||
           v == Coordinates<3>{62, 63, 63} || v == Coordinates<3>{9, 56, 32};
  };
  const DenseSigns<3> actual(Lattice<3>(box, 1), field);
  Side<3> encoder{DenseSigns<3>(Lattice<3>(box, 2), field).bricks()};
  Side<3> decoder{encoder.signs};
  const auto bytes =
      coded(actual.bricks(), NoScalars(), [&](auto& exchange) { encoder.refine(exchange); });
  ASSERT_TRUE(decoded<3>(bytes, [&](auto& exchange) { decoder.refine(exchange); }));
  EXPECT_EQ(DenseSigns<3>(decoder.signs), actual);
}

}  // namespace
}  // namespace isostar
