// RDOQ codes another interval than the actual one only where crossings move less by it, or where it
// saves enough bits.
#include "coding/exchange/rdoq_target.h"

#include <gtest/gtest.h>

#include "one_edge.h"

namespace isostar {
namespace {

constexpr uint32_t kWidth = 16;  // of the final intervals, in half quantization steps

/// The middle of the final interval that holds a magnitude, in half quantization steps.
uint32_t settled(uint32_t magnitude) {
  return 2 * magnitude / kWidth * kWidth + kWidth / 2;
}

TEST(RdoqTarget, isTheActualMagnitudeWithoutCrossings) {
  RdoqTarget<3> target(52, {});
  target.choose(128, 128, settled);
  EXPECT_EQ(target.magnitude(), 52u);
  Meter meter;
  EXPECT_FALSE(target.codeUpper(meter, 128, settled, [&](auto& coder) {
    return coder.bit(target.upper(128), kProbabilityOne - kLeastProbability);
  }));
}

TEST(RdoqTarget, compensatesForTheErrorOfTheFarEnd) {
  for (const uint32_t actual : {49u, 52u, 55u}) {
    for (const double far : {94.0, 100.0, 106.0}) {
      const auto distortion = oneEdge(2 * actual, far);
      RdoqTarget<3> target(actual, distortion);
      target.choose(128, 128, settled);
      const uint32_t own = settled(actual), coded = settled(target.magnitude());
      EXPECT_LE(distortion.of(coded), distortion.of(own));
      EXPECT_LE(coded, own + kWidth);
      EXPECT_GE(coded, own - kWidth);
      EXPECT_TRUE(coded == own || distortion.mayEndAt((coded + own) / 2));
    }
  }
  RdoqTarget<3> target(55, oneEdge(110, 106));
  target.choose(128, 128, settled);
  EXPECT_EQ(settled(target.magnitude()), settled(55) + kWidth);
}

TEST(RdoqTarget, staysInTheKnownInterval) {
  RdoqTarget<3> target(63, oneEdge(126, 110));
  target.choose(64, 64, settled);
  EXPECT_LT(target.magnitude(), 64u);
}

/// The half that is coded for a magnitude just below the middle, by the probability of the upper
/// half.
bool upperCoded(uint32_t probability) {
  Meter meter;
  RdoqTarget<3> target(55, oneEdge(111, 100));
  target.choose(128, 128, settled);
  const bool coded = target.codeUpper(
      meter, 112, settled, [&](auto& coder) { return coder.bit(target.upper(112), probability); });
  EXPECT_EQ(target.upper(112), coded);  // later decisions agree
  EXPECT_EQ(settled(target.magnitude()), coded ? 120u : 104u);
  return coded;
}

TEST(RdoqTarget, codesTheLikelyHalfWhereCrossingsHardlyMove) {
  EXPECT_FALSE(upperCoded(kProbabilityOne / 2));
  EXPECT_FALSE(upperCoded(kProbabilityOne / 100));
  EXPECT_TRUE(upperCoded(kProbabilityOne - 100));
}

TEST(RdoqTarget, codesTheActualHalfWhereCrossingsWouldMove) {
  Meter meter;
  RdoqTarget<3> target(49, oneEdge(98, 100));
  EXPECT_FALSE(target.codeUpper(meter, 112, settled, [&](auto& coder) {
    return coder.bit(target.upper(112), kProbabilityOne - kLeastProbability);
  }));
  EXPECT_EQ(target.magnitude(), 49u);
}

}  // namespace
}  // namespace isostar
