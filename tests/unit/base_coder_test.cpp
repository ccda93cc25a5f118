#include "coding/signs/base_coder.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

/// Lattices of some boxes, including boxes whose last cells are cut short.
template <int D>
std::vector<Lattice<D>> lattices() {
  std::vector<Lattice<D>> all;
  for (int32_t side : {1, 2, 3, 5, 8}) {
    if (D == 4 && side > 3) continue;
    Coordinates<D> box;
    for (int a = 0; a < D; ++a) box[a] = std::max(1, side - a);
    all.emplace_back(box, 1);
    for (int a = 0; a < D; ++a) box[a] = 4 * box[a] + a - 1;
    all.emplace_back(box, 4);
  }
  return all;
}

template <class Dimension>
class BaseCoderTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                                  std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(BaseCoderTest, Dimensions);

TYPED_TEST(BaseCoderTest, decodesEverySignOfEachField) {
  constexpr int D = TypeParam::value;
  for (const auto& lattice : lattices<D>()) {
    for (const auto& field : signFields<D>(lattice.box)) {
      SCOPED_TRACE(field.name + " in " + testing::PrintToString(lattice.box));
      const DenseSigns<D> actual(lattice, field.positive);
      Signs<D> encoded(lattice), found(lattice);
      const auto bytes = coded(actual.bricks(), NoScalars(),
                               [&](auto& exchange) { BaseCoder<D>().code(exchange, encoded); });
      EXPECT_TRUE(decoded<D>(bytes, [&](auto& exchange) { BaseCoder<D>().code(exchange, found); }));
      EXPECT_EQ(DenseSigns<D>(encoded), actual);
      EXPECT_EQ(DenseSigns<D>(found), actual);
    }
  }
}

TYPED_TEST(BaseCoderTest, randomDecisionsDecodeToTheSameSigns) {
  constexpr int D = TypeParam::value;
  for (const auto& lattice : lattices<D>()) {
    for (uint64_t seed = 0; seed < 30; ++seed) {
      const double rate = std::array{0.5, 0.1, 0.9, 1.0}[seed % 4];
      Signs<D> encoded(lattice), found(lattice);
      const auto bytes = randomlyCoded<D>(
          seed, rate, [&](auto& exchange) { BaseCoder<D>().code(exchange, encoded); });
      ASSERT_TRUE(decoded<D>(bytes, [&](auto& exchange) { BaseCoder<D>().code(exchange, found); }));
      ASSERT_EQ(DenseSigns<D>(found), DenseSigns<D>(encoded)) << "seed " << seed;
    }
  }
}

/// Counts how often the sign of each vertex is coded.
template <int D>
struct Counting : EncoderExchange<D, Meter, NoScalars> {
  using Base = EncoderExchange<D, Meter, NoScalars>;
  using Base::Base;
  [[nodiscard]] bool positive(const Coordinates<D>& v) const {
    ++queried[v];
    return Base::positive(v);
  }
  mutable std::map<Coordinates<D>, int> queried;
};

TYPED_TEST(BaseCoderTest, codesTheTubesVerticesOnceAndNoOthers) {
  constexpr int D = TypeParam::value;
  for (const auto& lattice : lattices<D>()) {
    for (const auto& field : signFields<D>(lattice.box)) {
      SCOPED_TRACE(field.name + " in " + testing::PrintToString(lattice.box));
      const auto actual = DenseSigns<D>(lattice, field.positive).bricks();
      std::set<Coordinates<D>> tube;
      for (std::size_t n = 0; n < Simplex<D>::count(lattice); ++n) {
        const auto simplex = Simplex<D>::at(n, lattice);
        int positives = 0;
        for (int i = 0; i <= D; ++i) positives += actual.at(simplex.vertex(i));
        if (positives == 0 || positives == D + 1) continue;
        for (int i = 0; i <= D; ++i) tube.insert(simplex.vertex(i));
      }
      Meter meter;
      const NoScalars none;
      Counting<D> exchange(meter, actual, none);
      Signs<D> signs(lattice);
      BaseCoder<D>().code(exchange, signs);
      if (tube.empty()) tube.insert(Coordinates<D>{});  // one sign stands for all
      EXPECT_EQ(exchange.queried.size(), tube.size());
      for (const auto& [vertex, times] : exchange.queried) {
        EXPECT_TRUE(tube.contains(vertex)) << testing::PrintToString(vertex);
        EXPECT_EQ(times, 1) << testing::PrintToString(vertex);
      }
    }
  }
}

TEST(BaseCoder, aUniformLatticeTakesOneByteAtMost) {
  const Lattice<3> lattice({8, 8, 8}, 1);
  for (bool positive : {false, true}) {
    const DenseSigns<3> actual(lattice, [=](const auto&) { return positive; });
    Signs<3> signs(lattice);
    EXPECT_LE(coded(actual.bricks(), NoScalars(),
                    [&](auto& exchange) { BaseCoder<3>().code(exchange, signs); })
                  .size(),
              1u);
    EXPECT_EQ(DenseSigns<3>(signs), actual);
  }
}

}  // namespace
}  // namespace isostar
