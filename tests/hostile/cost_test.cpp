// What a decoder spends on the streams that have cost most: memory within the stated bound, and
// work that ends with the budget of decisions.
#include "cost.h"
#include "costly_kinds.h"

namespace isostar {
namespace {

constexpr std::size_t kModels = 4u << 20;  // as Limits says
constexpr std::size_t kCopies = 3;         // of the stream, while the decoder's copy grows

TEST(HostileCost, memoryStaysWithinTheStatedBound) {
  for (const std::size_t memory : {std::size_t{1} << 20, std::size_t{8} << 20}) {
    Limits limits;
    limits.memory = memory;
    limits.decisions = 1u << 20;
    for (const CostlyStream& recipe : costlyKinds(40)) {
      const Bytes bytes = assembled(recipe, limits);
      const Cost cost = costOf(bytes, limits);
      EXPECT_LE(cost.peak, memory + kModels + kCopies * bytes.size()) << recipe.name;
    }
  }
}

TEST(HostileCost, allWorkIsChargedToTheBudget) {
  Limits ample, few;
  ample.decisions = 1u << 24;
  few.decisions = 1u << 18;
  int charged = 0;
  for (const CostlyStream& recipe : costlyKinds(20)) {
    const Bytes bytes = assembled(recipe, ample);
    const Cost all = costOf(bytes, ample);
    if (all.error == Error::None && all.layers < kMostLayers) continue;  // little work
    const Cost some = costOf(bytes, few);
    ++charged;
    EXPECT_EQ(some.error, Error::OverLimit) << recipe.name;
    EXPECT_LT(some.layers, all.layers) << recipe.name;
  }
  EXPECT_GE(charged, 13);
}

TEST(HostileCost, passesOverBricksThatHaveNothingEnd) {
  // 255 layers of a box without a surface: most have no decision.
  for (CostlyStream recipe : costlyKinds(200)) {
    if (recipe.name != "empty box") continue;
    Limits limits;
    const Bytes bytes = assembled(recipe, limits);
    limits.decisions = 1u << 20;
    EXPECT_EQ(costOf(bytes, limits).error, Error::OverLimit);
  }
}

}  // namespace
}  // namespace isostar
