// What is told instead of the truth: never worse for the crossings than the truth's interval, unless that saves enough.
#include "coding/exchange/rdoq_target.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

constexpr uint32_t kWidth = 16;  // of the intervals that halving ends with, half quanta

/// The middle of the interval that holds a magnitude.
uint32_t settled(uint32_t magnitude) { return 2 * magnitude / kWidth * kWidth + kWidth / 2; }

/// An edge of a vertex of so many half quanta to a far end of 100 that is told as `told`; 1/10 of it is allowed.
CrossingErrors<3> oneEdge(double size, double told, double most = 1) {
  CrossingErrors<3> errors(0.0);
  errors.add({size / (size + 100), 100, told, 10, 1, most});
  return errors;
}

TEST(CrossingErrors, areNoneWhereCrossingsLieAsTheyDo) {
  EXPECT_TRUE(CrossingErrors<3>().empty());
  EXPECT_NEAR(oneEdge(104, 100).of(104), 0, 1e-12);
  EXPECT_NEAR(oneEdge(104, 50).of(52), 0, 1e-12);
  EXPECT_GT(oneEdge(104, 50).of(104), 1);
}

TEST(CrossingErrors, countMuchMoreBeyondTheMost) {
  EXPECT_LT(oneEdge(100, 100, 1).of(120), 1);
  EXPECT_GT(oneEdge(100, 100, 0.1).of(120), 100);
}

TEST(CrossingErrors, leaveRoomForTheFarEnd) {
  EXPECT_TRUE(oneEdge(100, 500).mayEndAt(104));
  EXPECT_FALSE(oneEdge(100, 500).mayEndAt(120));
}

TEST(Aim, isTheTruthWhereNothingIsKnownOfCrossings) {
  Aim<3> aim(52, {});
  aim.choose(128, 128, settled);
  EXPECT_EQ(aim.magnitude(), 52u);
  Meter meter;
  EXPECT_FALSE(aim.persuade(meter, 128, settled, [&](auto& coder) { return coder.bit(aim.upper(128), kChanceOne - kLeastChance); }));
}

TEST(Aim, makesUpForWhatTheFarEndIsOff) {
  for (const uint32_t truth : {49u, 52u, 55u}) {
    for (const double far : {94.0, 100.0, 106.0}) {
      const auto errors = oneEdge(2 * truth, far);
      Aim<3> aim(truth, errors);
      aim.choose(128, 128, settled);
      const uint32_t own = settled(truth), told = settled(aim.magnitude());
      EXPECT_LE(errors.of(told), errors.of(own));
      EXPECT_LE(told, own + kWidth);
      EXPECT_GE(told, own - kWidth);
      EXPECT_TRUE(told == own || errors.mayEndAt((told + own) / 2));
    }
  }
  Aim<3> aim(55, oneEdge(110, 106));
  aim.choose(128, 128, settled);
  EXPECT_EQ(settled(aim.magnitude()), settled(55) + kWidth);
}

TEST(Aim, staysInTheIntervalThatIsKnown) {
  Aim<3> aim(63, oneEdge(126, 110));
  aim.choose(64, 64, settled);
  EXPECT_LT(aim.magnitude(), 64u);
}

/// What is told of a magnitude just below a middle, where the upper half is as likely as `chance` says.
bool upperTold(uint32_t chance) {
  Meter meter;
  Aim<3> aim(55, oneEdge(111, 100));
  aim.choose(128, 128, settled);
  const bool told = aim.persuade(meter, 112, settled, [&](auto& coder) { return coder.bit(aim.upper(112), chance); });
  EXPECT_EQ(aim.upper(112), told);  // so is what follows
  EXPECT_EQ(settled(aim.magnitude()), told ? 120u : 104u);
  return told;
}

TEST(Aim, tellsTheLikelyHalfWhereThatHardlyMatters) {
  EXPECT_FALSE(upperTold(kChanceOne / 2));
  EXPECT_FALSE(upperTold(kChanceOne / 100));
  EXPECT_TRUE(upperTold(kChanceOne - 100));
}

TEST(Aim, isNotPersuadedWhereCrossingsWouldMove) {
  Meter meter;
  Aim<3> aim(49, oneEdge(98, 100));
  EXPECT_FALSE(aim.persuade(meter, 112, settled, [&](auto& coder) { return coder.bit(aim.upper(112), kChanceOne - kLeastChance); }));
  EXPECT_EQ(aim.magnitude(), 49u);
}

}  // namespace
}  // namespace isostar
