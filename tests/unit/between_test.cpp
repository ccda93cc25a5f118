#include "decoder/between.h"

#include <gtest/gtest.h>

#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

const Coordinates<2> kBox{20, 17};
const Lattice<2> kLattice(kBox, 1);

/// The iso step of each vertex.
int32_t isoStepAt(const Coordinates<2>& v) {
  return 3 * v[0] - 2 * v[1] - 7;
}

Signs<2> signsAt(int32_t isoStep) {
  return DenseSigns<2>(kLattice, [=](const auto& v) { return isoStepAt(v) >= isoStep; }).bricks();
}

/// The scalars of all vertices relative to iso step 0.
Scalars<2> allScalars(const BrickTable<2>& table) {
  Scalars<2> scalars(table.total());
  forVertices(kLattice, [&](const Coordinates<2>& v) {
    const int32_t isoStep = isoStepAt(v);
    scalars.writable(table.brickIndexOf(v))
        .set(numberOf<2>(v), isoStep >= 0,
             static_cast<uint32_t>(isoStep >= 0 ? isoStep : -1 - isoStep), 0);
  });
  return scalars;
}

TEST(Between, isExactWhereAllScalarsAreKnown) {
  const auto first = signsAt(0);
  const auto scalars = allScalars(first.table());
  const FurtherIsovalues<2> none;
  for (const int32_t isoStep : {0, 3, -4, 11}) {
    Between<2> between(none, {0.0, first, scalars}, isoStep, isoStep, 0.5);
    EXPECT_EQ(DenseSigns<2>(between.signs()), DenseSigns<2>(signsAt(isoStep))) << isoStep;
    EXPECT_EQ(between.active(), activeBricks(between.signs()));
    forVertices(kLattice, [&](const Coordinates<2>& v) {
      const int32_t value =
          between.scalars().at(first.table().brickIndexOf(v)).value[numberOf<2>(v)];
      EXPECT_EQ(value, (2 * (isoStepAt(v) - isoStep) + 1) * (1 << between.finer()));
    });
  }
}

TEST(Between, dependsOnTheNearerIsovalueWhereNoScalarIsKnown) {
  constexpr int32_t kUpper = 10;
  const auto first = signsAt(0), upper = signsAt(kUpper);
  const Scalars<2> none(first.table().total());
  FurtherIsovalues<2> further;
  const FurtherIsovalues<2>::First known{0.0, first, none};
  (void)coded(upper, NoScalars(),
              [&](auto& exchange) { further.signs(exchange, known, kUpper, kUpper, 0); });
  for (const int32_t isoStep : {1, 4, 6, 9}) {
    const Between<2> between(further, known, isoStep, isoStep, 0.5);
    EXPECT_EQ(DenseSigns<2>(between.signs()), DenseSigns<2>(isoStep < kUpper / 2 ? first : upper))
        << isoStep;
  }
}

TEST(Between, takesNoMoreMemoryThanAnnounced) {
  const auto first = signsAt(0);
  const auto scalars = allScalars(first.table());
  const FurtherIsovalues<2> none;
  const Between<2> between(none, {0.0, first, scalars}, 3, 3, 0.5);
  EXPECT_LE(between.memory(), Between<2>::memoryToMake(none, {0.0, first, scalars}, 3));
}

}  // namespace
}  // namespace isostar
