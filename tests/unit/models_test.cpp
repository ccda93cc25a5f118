#include "entropy/models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace isostar {
namespace {

template <class Coder>
void mix(Coder& coder, bool truth, const std::array<Chance*, 3>& contexts, Mixer<3>::Weights& weights) {
  EXPECT_EQ((Mixer<3>::bit<255, 12>(coder, truth, contexts, weights)), truth);
}

/// Keeps the last chance that it was asked with.
struct Listener {
  uint32_t chance = 0;
  bool bit(bool truth, uint32_t c) {
    chance = c;
    return truth;
  }
};

TEST(Logistic, squashRisesWithinBounds) {
  uint32_t before = 0;
  for (int x = -3000; x <= 3000; ++x) {
    const uint32_t chance = Logistic::squash(x);
    EXPECT_GE(chance, before);
    EXPECT_GE(chance, kLeastChance);
    EXPECT_LE(chance, kChanceOne - kLeastChance);
    before = chance;
  }
  EXPECT_EQ(Logistic::squash(0), kChanceOne / 2);
}

TEST(Logistic, stretchIsItsInverse) {
  for (uint32_t chance = 0; chance < kChanceOne; chance += 7) {
    const int logOdds = Logistic::stretch(chance);
    EXPECT_LE(std::abs(logOdds), Logistic::kBound);
    const uint32_t low = Logistic::squash(logOdds - 1), high = Logistic::squash(logOdds + 1);
    EXPECT_LE(low, std::max(chance, kLeastChance) + 16) << chance;
    EXPECT_GE(high + 16, std::min(chance, kChanceOne - kLeastChance)) << chance;
  }
}

TEST(Logistic, isNearTheTrueFunction) {
  for (int x = -2047; x <= 2047; ++x) {
    const double exact = 65536 / (1 + std::exp(-x / 256.0));
    EXPECT_NEAR(Logistic::squash(x), exact, 30 + exact * 0.02) << x;
  }
}

TEST(Chance, startsUndecided) {
  EXPECT_EQ(Chance().value(), kChanceOne / 2);
}

TEST(Chance, staysWithinBounds) {
  Chance up, down;
  for (int i = 0; i < 100000; ++i) {
    up.learn<1023>(true);
    down.learn<1023>(false);
  }
  EXPECT_LE(up.value(), kChanceOne - kLeastChance);
  EXPECT_GT(up.value(), kChanceOne - 200);
  EXPECT_GE(down.value(), kLeastChance);
  EXPECT_LT(down.value(), 200u);
}

template <int Limit>
void expectConvergence(double rate) {
  std::mt19937_64 random(5);
  Chance chance;
  double sum = 0;
  constexpr int kDecisions = 20000, kSettled = 4000;
  for (int i = 0; i < kDecisions; ++i) {
    chance.learn<Limit>(static_cast<double>(random() >> 11) < rate * 0x1p53);
    if (i >= kSettled) sum += chance.value();
  }
  EXPECT_NEAR(sum / (kDecisions - kSettled) / kChanceOne, rate, 0.01) << Limit;
}

TEST(Chance, convergesToTheRate) {
  for (double rate : {0.01, 0.1, 0.5, 0.8, 0.99}) {
    expectConvergence<127>(rate);
    expectConvergence<255>(rate);
    expectConvergence<1023>(rate);
  }
}

TEST(Chance, learnsFastAtFirst) {
  Chance chance;
  for (int i = 0; i < 4; ++i) chance.learn<255>(true);
  EXPECT_GT(chance.value(), kChanceOne * 4 / 5);
}

TEST(Mixer, saysNothingBeforeItHasSeenAnything) {
  Chance a, b, c;
  auto weights = Mixer<3>::fresh();
  Listener listener;
  mix(listener, true, {&a, &b, &c}, weights);
  EXPECT_NEAR(listener.chance, kChanceOne / 2, kChanceOne / 500.0);
}

/// Bits a decision when one of three contexts tells all and the others nothing.
TEST(Mixer, findsTheContextThatKnows) {
  std::mt19937_64 random(9);
  std::array<Chance, 2> knows;
  Chance blind, deaf;
  auto weights = Mixer<3>::fresh();
  Meter all, late;
  constexpr int kDecisions = 8000;
  for (int i = 0; i < kDecisions; ++i) {
    const bool truth = (random() & 1) != 0, seldom = random() % 100 == 0;
    auto& context = knows[truth != seldom ? 1 : 0];
    mix(i < kDecisions / 2 ? all : late, truth, {&blind, &context, &deaf}, weights);
  }
  EXPECT_LT(late.bits() / (kDecisions / 2), 0.12);  // entropy of one in hundred: 0.08
}

TEST(Mixer, agreesWithTheBestOfEqualContexts) {
  std::array<Chance, 3> same;
  auto weights = Mixer<3>::fresh();
  Meter meter;
  for (int i = 0; i < 4000; ++i) mix(meter, true, {&same[0], &same[1], &same[2]}, weights);
  EXPECT_LT(meter.bits(), 20);
}

TEST(Mixer, believesAnEstimateAtOnceAndMoreWhenItIsRight) {
  Chance a, b, c;
  auto weights = Mixer<3>::freshWithEstimate();
  Listener listener;
  const std::array<Chance*, 3> contexts{&a, &b, &c};
  Mixer<3>::bit<255, 12>(listener, true, contexts, weights, 512);
  EXPECT_NEAR(listener.chance, kChanceOne / (1 + std::exp(-1.0)), kChanceOne / 200.0) << "half of the estimate's log-odds";
  std::mt19937_64 random(3);
  Meter meter;
  constexpr int kDecisions = 4000;
  for (int i = 0; i < kDecisions; ++i) {
    const bool truth = (random() & 1) != 0;
    Mixer<3>::bit<255, 12>(meter, truth, contexts, weights, truth ? 700 : -700);
  }
  EXPECT_LT(meter.bits() / kDecisions, 0.02);
}

TEST(Mixer, boundsAnEstimate) {
  Chance a, b, c;
  auto weights = Mixer<3>::freshWithEstimate();
  Listener listener;
  Mixer<3>::bit<255, 12>(listener, true, {&a, &b, &c}, weights, 1 << 30);
  EXPECT_LE(listener.chance, kChanceOne - kLeastChance);
  EXPECT_GT(listener.chance, kChanceOne * 9 / 10);
}

}  // namespace
}  // namespace isostar
