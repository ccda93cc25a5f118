#include "coding/geometry/magnitude_coder.h"

#include <gtest/gtest.h>

#include "scalar_coding.h"

namespace isostar {
namespace {

template <class Dimension>
class MagnitudeCoderTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MagnitudeCoderTest, Dimensions);

TYPED_TEST(MagnitudeCoderTest, intervalsHoldTheActualMagnitudesAfterEachPass) {
  constexpr int D = TypeParam::value;
  for (const auto& field : wholeFields<D>()) {
    for (const int exponentRange : {0, 3, 30}) {
      SCOPED_TRACE(field.name + ", exponentRange " + std::to_string(exponentRange));
      ScalarRoundTrip<D> roundTrip(scalarBox<D>(), field.value);
      for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
        roundTrip.exponents(members, exponentRange);
        roundTrip.expectActualInside(members);
      }
      for (uint32_t allowed : {8000u, 1000u}) {
        for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
          roundTrip.magnitudePass(members, sameOnAllEdges<D>(allowed), allowed == 8000 ? 2 : 30,
                                  allowed == 1000);
          roundTrip.expectActualInside(members);
        }
      }
    }
  }
}

TYPED_TEST(MagnitudeCoderTest, crossingsOfASmoothFieldKeepTheBound) {
  constexpr int D = TypeParam::value;
  ScalarRoundTrip<D> roundTrip(scalarBox<D>(), wholeFields<D>()[0].value);
  roundTrip.exponents(Members::AxisEnds, 3);
  for (uint32_t allowed : {13000u, 3300u, 650u}) {
    roundTrip.magnitudePass(Members::AxisEnds, sameOnAllEdges<D>(allowed), 30, false);
    // A quarter more: how far a crossing moves is estimated to first order.
    EXPECT_LE(roundTrip.furthest(), allowed / 65536.0 * 1.25);
  }
}

TYPED_TEST(MagnitudeCoderTest, magnitudesAreExactWhereCrossingsMayNotMove) {
  constexpr int D = TypeParam::value;
  for (const auto& field : wholeFields<D>()) {
    SCOPED_TRACE(field.name);
    ScalarRoundTrip<D> roundTrip(scalarBox<D>(), field.value);
    auto nothing = sameOnAllEdges<D>(0);
    nothing.back() = 1;  // diagonals count
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      roundTrip.exponents(members, 3);
      roundTrip.magnitudePass(members, nothing, 30, false);
      roundTrip.expectActualInside(members);
    }
    EXPECT_LE(roundTrip.furthest(), 0x1p-18);
    if (field.name == "large" || field.name == "all scales")
      continue;  // more bits than a single-precision vertex holds
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      roundTrip.forMembers(members,
                           [&](const Coordinates<D>& v, const auto& brick, std::size_t at) {
                             EXPECT_EQ(brick.width(at), 0) << testing::PrintToString(v);
                           });
    }
  }
}

TYPED_TEST(MagnitudeCoderTest, randomDecisionsDecodeToTheSameScalars) {
  constexpr int D = TypeParam::value;
  for (uint64_t seed = 0; seed < 24; ++seed) {
    const double rate = std::array{0.5, 0.05, 0.98, 1.0}[seed % 4];
    const int exponentRange = static_cast<int>(seed / 4 % 3) * 4;
    const auto signs = DenseSigns<D>(Lattice<D>(scalarBox<D>(), 1),
                                     signFields<D>(scalarBox<D>())[seed % 6].positive)
                           .bricks();
    ScalarSide<D> encoder(signs), decoder(signs);
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      auto exponents = [&](auto& exchange, ScalarSide<D>& side) {
        side.exponents.code(exchange, signs, side.scalars, members, exponentRange, side.active);
      };
      auto magnitudePass = [&](auto& exchange, ScalarSide<D>& side) {
        side.magnitudes.code(
            exchange, signs, side.scalars,
            {members, sameOnAllEdges<D>(static_cast<uint32_t>(seed) * 100), 30, seed % 2 == 0},
            side.active);
      };
      const auto first =
          randomlyCoded<D>(seed, rate, [&](auto& exchange) { exponents(exchange, encoder); });
      ASSERT_TRUE(decoded<D>(first, [&](auto& exchange) { exponents(exchange, decoder); }));
      ASSERT_TRUE(equal(encoder, decoder)) << "seed " << seed;
      const auto second =
          randomlyCoded<D>(seed, rate, [&](auto& exchange) { magnitudePass(exchange, encoder); });
      ASSERT_TRUE(decoded<D>(second, [&](auto& exchange) { magnitudePass(exchange, decoder); }));
      ASSERT_TRUE(equal(encoder, decoder)) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace isostar
