#include "entropy/models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace isostar {
namespace {

template <class Coder>
void mix(Coder& coder, bool actual, const std::array<BitModel*, 3>& contexts,
         Mixer<3>::Weights& weights) {
  EXPECT_EQ((Mixer<3>::bit<255, 12>(coder, actual, contexts, weights)), actual);
}

/// A coder that records the last probability.
struct ProbabilityRecorder {
  uint32_t probability = 0;
  bool bit(bool actual, uint32_t c) {
    probability = c;
    return actual;
  }
};

TEST(Logistic, squashRisesWithinBounds) {
  uint32_t before = 0;
  for (int x = -3000; x <= 3000; ++x) {
    const uint32_t probability = Logistic::squash(x);
    EXPECT_GE(probability, before);
    EXPECT_GE(probability, kLeastProbability);
    EXPECT_LE(probability, kProbabilityOne - kLeastProbability);
    before = probability;
  }
  EXPECT_EQ(Logistic::squash(0), kProbabilityOne / 2);
}

TEST(Logistic, stretchIsItsInverse) {
  for (uint32_t probability = 0; probability < kProbabilityOne; probability += 7) {
    const int logOdds = Logistic::stretch(probability);
    EXPECT_LE(std::abs(logOdds), Logistic::kBound);
    const uint32_t low = Logistic::squash(logOdds - 1), high = Logistic::squash(logOdds + 1);
    EXPECT_LE(low, std::max(probability, kLeastProbability) + 16) << probability;
    EXPECT_GE(high + 16, std::min(probability, kProbabilityOne - kLeastProbability)) << probability;
  }
}

TEST(Logistic, isCloseToTheExactFunction) {
  for (int x = -2047; x <= 2047; ++x) {
    const double exact = 65536 / (1 + std::exp(-x / 256.0));
    EXPECT_NEAR(Logistic::squash(x), exact, 30 + exact * 0.02) << x;
  }
}

TEST(BitModel, startsUndecided) {
  EXPECT_EQ(BitModel().value(), kProbabilityOne / 2);
}

TEST(BitModel, staysWithinBounds) {
  BitModel up, down;
  for (int i = 0; i < 100000; ++i) {
    up.learn<1023>(true);
    down.learn<1023>(false);
  }
  EXPECT_LE(up.value(), kProbabilityOne - kLeastProbability);
  EXPECT_GT(up.value(), kProbabilityOne - 200);
  EXPECT_GE(down.value(), kLeastProbability);
  EXPECT_LT(down.value(), 200u);
}

template <int Limit>
void expectConvergence(double rate) {
  std::mt19937_64 random(5);
  BitModel model;
  double sum = 0;
  constexpr int kDecisions = 20000, kSettled = 4000;
  for (int i = 0; i < kDecisions; ++i) {
    model.learn<Limit>(static_cast<double>(random() >> 11) < rate * 0x1p53);
    if (i >= kSettled) sum += model.value();
  }
  EXPECT_NEAR(sum / (kDecisions - kSettled) / kProbabilityOne, rate, 0.01) << Limit;
}

TEST(BitModel, convergesToTheRate) {
  for (double rate : {0.01, 0.1, 0.5, 0.8, 0.99}) {
    expectConvergence<127>(rate);
    expectConvergence<255>(rate);
    expectConvergence<1023>(rate);
  }
}

TEST(BitModel, learnsFastAtFirst) {
  BitModel model;
  for (int i = 0; i < 4; ++i) model.learn<255>(true);
  EXPECT_GT(model.value(), kProbabilityOne * 4 / 5);
}

TEST(Mixer, isUndecidedBeforeTheFirstDecision) {
  BitModel a, b, c;
  auto weights = Mixer<3>::initialWeights();
  ProbabilityRecorder recorder;
  mix(recorder, true, {&a, &b, &c}, weights);
  EXPECT_NEAR(recorder.probability, kProbabilityOne / 2, kProbabilityOne / 500.0);
}

/// Bits per decision when one of three contexts is informative and the others are not.
TEST(Mixer, findsTheInformativeContext) {
  std::mt19937_64 random(9);
  std::array<BitModel, 2> informative;
  BitModel other, another;
  auto weights = Mixer<3>::initialWeights();
  Meter all, late;
  constexpr int kDecisions = 8000;
  for (int i = 0; i < kDecisions; ++i) {
    const bool actual = (random() & 1) != 0, rare = random() % 100 == 0;
    auto& context = informative[actual != rare ? 1 : 0];
    mix(i < kDecisions / 2 ? all : late, actual, {&other, &context, &another}, weights);
  }
  EXPECT_LT(late.bits() / (kDecisions / 2), 0.12);  // the entropy of one in a hundred is 0.08
}

TEST(Mixer, agreesWithTheBestOfEqualContexts) {
  std::array<BitModel, 3> same;
  auto weights = Mixer<3>::initialWeights();
  Meter meter;
  for (int i = 0; i < 4000; ++i) mix(meter, true, {&same[0], &same[1], &same[2]}, weights);
  EXPECT_LT(meter.bits(), 20);
}

TEST(Mixer, trustsAnEstimateAtOnceAndMoreWhenItIsRight) {
  BitModel a, b, c;
  auto weights = Mixer<3>::initialWeightsWithEstimate();
  ProbabilityRecorder recorder;
  const std::array<BitModel*, 3> contexts{&a, &b, &c};
  Mixer<3>::bit<255, 12>(recorder, true, contexts, weights, 512);
  EXPECT_NEAR(recorder.probability, kProbabilityOne / (1 + std::exp(-1.0)), kProbabilityOne / 200.0)
      << "half of the estimate's log-odds";
  std::mt19937_64 random(3);
  Meter meter;
  constexpr int kDecisions = 4000;
  for (int i = 0; i < kDecisions; ++i) {
    const bool actual = (random() & 1) != 0;
    Mixer<3>::bit<255, 12>(meter, actual, contexts, weights, actual ? 700 : -700);
  }
  EXPECT_LT(meter.bits() / kDecisions, 0.02);
}

TEST(Mixer, boundsAnEstimate) {
  BitModel a, b, c;
  auto weights = Mixer<3>::initialWeightsWithEstimate();
  ProbabilityRecorder recorder;
  Mixer<3>::bit<255, 12>(recorder, true, {&a, &b, &c}, weights, 1 << 30);
  EXPECT_LE(recorder.probability, kProbabilityOne - kLeastProbability);
  EXPECT_GT(recorder.probability, kProbabilityOne * 9 / 10);
}

}  // namespace
}  // namespace isostar
