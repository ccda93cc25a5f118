#include "coding/exchange/exchange.h"

#include <gtest/gtest.h>

#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

using Encoder = EncoderExchange<3, Meter, NoScalars>;

TEST(EncoderExchange, answersWithTheSourcesSigns) {
  const Coordinates<3> box{10, 9, 8};
  const DenseSigns<3> dense(Lattice<3>(box, 1), signFields<3>(box)[0].positive);
  const auto signs = dense.bricks();
  Meter meter;
  const NoScalars none;
  const Encoder exchange(meter, signs, none);
  forVertices(signs.lattice(), [&](const Coordinates<3>& v) {
    EXPECT_EQ(exchange.positive(v), dense.at(v));
    const auto r = static_cast<std::size_t>((v[1] & 7) + 8 * (v[2] & 7));
    EXPECT_EQ((exchange.row(signs.table().brickIndexOf(v), r) >> (v[0] & 7) & 1) != 0, dense.at(v));
  });
  EXPECT_FALSE(exchange.exhausted());
}

TEST(EncoderExchange, findsTheFirstCrossingSimplexThatIsNotVisited) {
  const Lattice<3> lattice({3, 3, 3}, 1);
  const auto signs = DenseSigns<3>(lattice, [](const auto& v) {
                       return v == Coordinates<3>{2, 2, 2};
                     }).bricks();
  Meter meter;
  const NoScalars none;
  const Encoder exchange(meter, signs, none);
  std::vector<uint8_t> visited(Simplex<3>::count(lattice));
  int seeds = 0;
  std::size_t before = 0;
  while (const auto seed = exchange.nextSeed(lattice, visited)) {
    bool hasVertex = false;
    for (int i = 0; i <= 3; ++i)
      hasVertex = hasVertex || seed->vertex(i) == Coordinates<3>{2, 2, 2};
    EXPECT_TRUE(hasVertex);
    EXPECT_GE(seed->index(lattice), before);
    before = seed->index(lattice);
    visited[before] = 1;
    ++seeds;
  }
  EXPECT_EQ(seeds, 48) << "(2, 2, 2) is an even corner: all simplices of eight cells meet there";
}

TEST(EncoderExchange, entersTheLevelsOfALayer) {
  const Lattice<3> lattice({3, 3, 3}, 1);
  const std::vector<Signs<3>> levels{
      DenseSigns<3>(lattice, [](const auto&) { return false; }).bricks(),
      DenseSigns<3>(lattice, [](const auto&) { return true; }).bricks()};
  Meter meter;
  const NoScalars none;
  Encoder exchange(meter, levels[0], none);
  exchange.setLevels(levels, levels);
  exchange.enterLevel(1);
  EXPECT_TRUE(exchange.positive({1, 1, 1}));
  exchange.enterLevel(0);
  EXPECT_FALSE(exchange.positive({1, 1, 1}));
}

TEST(DecoderExchange, isExhaustedBeyondItsSlack) {
  RangeDecoder coder(std::span<const std::byte>{});
  DecoderExchange<3> exchange(coder, 8, UINT64_MAX);
  int bits = 0;
  for (; !exchange.exhausted(); ++bits) {
    ASSERT_LT(bits, 100);
    (void)coder.bit(false, kProbabilityOne / 2);
  }
  EXPECT_GE(bits, 8 * 4) << "four bytes of the slack are read ahead";
}

TEST(DecoderExchange, staysOverBudget) {
  RangeDecoder coder(std::span<const std::byte>{});
  DecoderExchange<3> exchange(coder, 8, 1000);
  EXPECT_TRUE(exchange.charge(1000));
  exchange.hold(400);
  EXPECT_TRUE(exchange.charge(600));
  EXPECT_FALSE(exchange.charge(601));
  EXPECT_TRUE(exchange.overBudget() && exchange.exhausted());
  EXPECT_FALSE(exchange.charge(0)) << "what was decoded since may be incomplete";
}

/// How much work is one brick more.
template <int D>
uint64_t workOfBrick() {
  RangeDecoder coder(std::span<const std::byte>{});
  DecoderExchange<D> exchange(coder, 8, UINT64_MAX);
  exchange.visitBrick();
  return exchange.work();
}

TEST(DecoderExchange, chargesWhatIsGoneThroughWithoutADecision) {
  EXPECT_EQ(workOfBrick<2>(), 8);
  EXPECT_EQ(workOfBrick<3>(), 64);
  EXPECT_EQ(workOfBrick<4>(), 512);
  RangeDecoder coder(std::span<const std::byte>{});
  DecoderExchange<3> exchange(coder, 8, UINT64_MAX, 10);
  exchange.visit(9);
  EXPECT_TRUE(exchange.charge(0));
  EXPECT_FALSE(exchange.charge(0)) << "bricks that are passed over count, too";
  EXPECT_TRUE(exchange.overBudget());
}

}  // namespace
}  // namespace isostar
