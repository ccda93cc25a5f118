// What is told instead of the truth: never worse for the crossings than the truth's interval,
// unless that saves enough.
#include "coding/exchange/rdoq_target.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

constexpr uint32_t kWidth = 16;  // of the intervals that halving ends with, half quanta

/// The middle of the interval that holds a magnitude.
uint32_t settled(uint32_t magnitude) {
  return 2 * magnitude / kWidth * kWidth + kWidth / 2;
}

/// An edge of a vertex of so many half quanta to a far end of 100 that is told as `told`; 1/10 of
/// it is allowed.
CrossingDistortion<3> oneEdge(double size, double coded, double most = 1) {
  CrossingDistortion<3> errors(0.0);
  errors.add({size / (size + 100), 100, coded, 10, 1, most});
  return errors;
}

TEST(CrossingDistortion, areNoneWhereCrossingsLieAsTheyDo) {
  EXPECT_TRUE(CrossingDistortion<3>().empty());
  EXPECT_NEAR(oneEdge(104, 100).of(104), 0, 1e-12);
  EXPECT_NEAR(oneEdge(104, 50).of(52), 0, 1e-12);
  EXPECT_GT(oneEdge(104, 50).of(104), 1);
}

TEST(CrossingDistortion, countMuchMoreBeyondTheMost) {
  EXPECT_LT(oneEdge(100, 100, 1).of(120), 1);
  EXPECT_GT(oneEdge(100, 100, 0.1).of(120), 100);
}

TEST(CrossingDistortion, leaveRoomForTheFarEnd) {
  EXPECT_TRUE(oneEdge(100, 500).mayEndAt(104));
  EXPECT_FALSE(oneEdge(100, 500).mayEndAt(120));
}

TEST(RdoqTarget, isTheTruthWhereNothingIsKnownOfCrossings) {
  RdoqTarget<3> target(52, {});
  target.choose(128, 128, settled);
  EXPECT_EQ(target.magnitude(), 52u);
  Meter meter;
  EXPECT_FALSE(target.codeUpper(meter, 128, settled, [&](auto& coder) {
    return coder.bit(target.upper(128), kProbabilityOne - kLeastProbability);
  }));
}

TEST(RdoqTarget, makesUpForWhatTheFarEndIsOff) {
  for (const uint32_t actual : {49u, 52u, 55u}) {
    for (const double far : {94.0, 100.0, 106.0}) {
      const auto errors = oneEdge(2 * actual, far);
      RdoqTarget<3> target(actual, errors);
      target.choose(128, 128, settled);
      const uint32_t own = settled(actual), coded = settled(target.magnitude());
      EXPECT_LE(errors.of(coded), errors.of(own));
      EXPECT_LE(coded, own + kWidth);
      EXPECT_GE(coded, own - kWidth);
      EXPECT_TRUE(coded == own || errors.mayEndAt((coded + own) / 2));
    }
  }
  RdoqTarget<3> target(55, oneEdge(110, 106));
  target.choose(128, 128, settled);
  EXPECT_EQ(settled(target.magnitude()), settled(55) + kWidth);
}

TEST(RdoqTarget, staysInTheIntervalThatIsKnown) {
  RdoqTarget<3> target(63, oneEdge(126, 110));
  target.choose(64, 64, settled);
  EXPECT_LT(target.magnitude(), 64u);
}

/// What is told of a magnitude just below a middle, where the upper half is as likely as `chance`
/// says.
bool upperCoded(uint32_t probability) {
  Meter meter;
  RdoqTarget<3> target(55, oneEdge(111, 100));
  target.choose(128, 128, settled);
  const bool coded = target.codeUpper(
      meter, 112, settled, [&](auto& coder) { return coder.bit(target.upper(112), probability); });
  EXPECT_EQ(target.upper(112), coded);  // so is what follows
  EXPECT_EQ(settled(target.magnitude()), coded ? 120u : 104u);
  return coded;
}

TEST(RdoqTarget, tellsTheLikelyHalfWhereThatHardlyMatters) {
  EXPECT_FALSE(upperCoded(kProbabilityOne / 2));
  EXPECT_FALSE(upperCoded(kProbabilityOne / 100));
  EXPECT_TRUE(upperCoded(kProbabilityOne - 100));
}

TEST(RdoqTarget, isNotPersuadedWhereCrossingsWouldMove) {
  Meter meter;
  RdoqTarget<3> target(49, oneEdge(98, 100));
  EXPECT_FALSE(target.codeUpper(meter, 112, settled, [&](auto& coder) {
    return coder.bit(target.upper(112), kProbabilityOne - kLeastProbability);
  }));
  EXPECT_EQ(target.magnitude(), 49u);
}

}  // namespace
}  // namespace isostar
