#include "util/reciprocal.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

TEST(Reciprocal, isAFixedPointQuotient) {
  EXPECT_EQ(reciprocal(0), 0);
  EXPECT_EQ(reciprocal(1), 65536);
  EXPECT_EQ(reciprocal(3), 21845);
  EXPECT_EQ(reciprocal(255), 257);
}

TEST(Reciprocal, givesMeansToWithinOne) {
  for (int32_t n = 1; n < 256; ++n) {
    for (int64_t sum = 0; sum < 200 * n; sum += 7) {
      const int64_t mean = sum * reciprocal(n) >> 16;
      EXPECT_LE(mean, sum / n);
      EXPECT_GE(mean, sum / n - 1) << sum << " / " << n;
    }
  }
}

}  // namespace
}  // namespace isostar
