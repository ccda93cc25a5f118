#include "scalars/scalars.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

TEST(ScalarBrick, holdsIntervalsOfEachWidthAndSign) {
  auto brick = ScalarBrick<2>::unknown();
  EXPECT_FALSE(brick.knows(3));
  for (int width = 0; width < 29; ++width) {
    for (const uint32_t multiple : {0u, 1u, 2u, 5u}) {
      const uint32_t low = multiple << width;
      if (low >> 29 != 0) continue;
      for (const bool positive : {true, false}) {
        brick.set(3, positive, low, width);
        ASSERT_TRUE(brick.knows(3));
        EXPECT_EQ(brick.value[3] > 0, positive);
        EXPECT_EQ(brick.low(3), low);
        EXPECT_EQ(brick.width(3), width);
        EXPECT_EQ(brick.middle(3), 2 * low + (1u << width));
      }
    }
  }
  EXPECT_FALSE(brick.knows(4));
}

TEST(Scalars, haveAGradientOnlyWhereItIsSet) {
  Scalars<3> scalars(5);
  EXPECT_FALSE(scalars.hasGradient(2));
  scalars.setGradient(2, 4 * 31);
  EXPECT_TRUE(scalars.hasGradient(2));
  EXPECT_EQ(scalars.gradient(2), 4 * 31);
  EXPECT_FALSE(scalars.hasGradient(3));
  EXPECT_FALSE(scalars.has(2)) << "a gradient needs no brick";
}

/// The exponent by which scalars of one magnitude are magnified.
int exponentFor(int32_t value) {
  Scalars<2> scalars(2);
  scalars.writable(1).value[7] = value;
  scalars.writable(1).value[8] = -value;
  const int exponent = scalars.magnify();
  EXPECT_EQ(scalars.at(1).value[7], value << exponent);
  EXPECT_EQ(scalars.at(1).value[8], -(value << exponent));
  EXPECT_FALSE(scalars.at(1).knows(9));
  EXPECT_FALSE(scalars.at(0).knows(7)) << "unknown values stay unknown";
  return exponent;
}

TEST(Scalars, magnifyAsFarAsThereIsRoom) {
  EXPECT_EQ(exponentFor(1), 12);
  EXPECT_EQ(exponentFor((1 << 17) - 1), 12);
  EXPECT_EQ(exponentFor(1 << 17), 11);
  EXPECT_EQ(exponentFor(1 << 28), 0);
  EXPECT_EQ(exponentFor(INT32_MAX / 2), 0);
}

}  // namespace
}  // namespace isostar
