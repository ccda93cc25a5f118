#include "coding/geometry/exponent_coder.h"

#include <gtest/gtest.h>

#include "scalar_coding.h"

namespace isostar {
namespace {

template <class Dimension>
class ExponentCoderTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ExponentCoderTest, Dimensions);

TYPED_TEST(ExponentCoderTest, intervalsArePowersOfTwo) {
  constexpr int D = TypeParam::value;
  for (const auto& field : wholeFields<D>()) {
    SCOPED_TRACE(field.name);
    ScalarRoundTrip<D> roundTrip(scalarBox<D>(), field.value);
    roundTrip.exponents(Members::AxisEnds, 30);
    roundTrip.expectActualInside(Members::AxisEnds);
    roundTrip.forMembers(Members::AxisEnds,
                         [](const Coordinates<D>& v, const auto& brick, std::size_t at) {
                           const uint32_t low = brick.low(at), width = 1u << brick.width(at);
                           EXPECT_TRUE(low == 0 || low == width) << testing::PrintToString(v);
                         });
  }
}

TYPED_TEST(ExponentCoderTest, holdsTheSteepestGradient) {
  constexpr int D = TypeParam::value;
  for (const auto& field : wholeFields<D>()) {
    SCOPED_TRACE(field.name);
    ScalarRoundTrip<D> roundTrip(scalarBox<D>(), field.value);
    roundTrip.steepen(4 * 31 + 3);
    roundTrip.exponents(Members::AxisEnds, 0);
    roundTrip.magnitudePass(Members::AxisEnds, sameOnAllEdges<D>(650), 30, false);
    roundTrip.expectActualInside(Members::AxisEnds);
  }
}

}  // namespace
}  // namespace isostar
