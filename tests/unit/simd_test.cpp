#include "util/simd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace isostar {
namespace {

std::array<int32_t, 4> valuesOf(Lanes lanes) {
  return {lanes[0], lanes[1], lanes[2], lanes[3]};
}

TEST(Lanes, loadFromAnyAddress) {
  const std::array<int32_t, 6> numbers{9, 1, 2, 3, 4, 9};
  EXPECT_EQ(valuesOf(lanesAt(&numbers[1])), (std::array<int32_t, 4>{1, 2, 3, 4}));
}

TEST(Lanes, sumsAreThoseOfEachArgument) {
  EXPECT_EQ(valuesOf(sums(Lanes{1, 2, 3, 4}, Lanes{10, 20, 30, 40}, Lanes{-1, 1, -1, 1},
                          Lanes{0, 0, 0, 7})),
            (std::array<int32_t, 4>{10, 100, 0, 7}));
}

TEST(Lanes, compareAndClampLaneByLane) {
  std::mt19937 random(1);
  for (int n = 0; n < 1000; ++n) {
    Lanes a, b;
    for (int i = 0; i < 4; ++i) {
      a[i] = static_cast<int32_t>(random());
      b[i] = static_cast<int32_t>(random());
    }
    const auto bound = static_cast<int32_t>(random() >> 1);
    const Lanes low = smaller(a, b), high = larger(a, b), inside = clamped(a, bound);
    for (int i = 0; i < 4; ++i) {
      ASSERT_EQ(low[i], std::min<int32_t>(a[i], b[i]));
      ASSERT_EQ(high[i], std::max<int32_t>(a[i], b[i]));
      ASSERT_EQ(inside[i], std::clamp<int32_t>(a[i], -bound, bound));
    }
  }
}

TEST(Log2Eighths, isZeroOfZeroAndExactAtPowersOfTwo) {
  EXPECT_EQ(valuesOf(log2Eighths(Lanes{0, 1, 2, 4})), (std::array<int32_t, 4>{0, 1, 9, 17}));
  EXPECT_EQ(valuesOf(log2Eighths(Lanes{1 << 10, 1 << 20, 1 << 24, 1 << 30})),
            (std::array<int32_t, 4>{81, 161, 193, 241}));
}

TEST(Log2Eighths, risesAndStaysBelowTheLogarithm) {
  int32_t before = 0;
  for (int32_t n = 1; n < 1 << 22; n += 1 + n / 37) {
    const int32_t found = log2Eighths(Lanes{n, n, n, n})[2];
    EXPECT_GE(found, before);
    // The mantissa stands in for its logarithm, which is at most 0.0861 larger.
    const double exact = 8 * std::log2(n) + 1;
    EXPECT_LE(found, exact + 1e-9) << n;
    EXPECT_GT(found, exact - 1 - 8 * 0.0861) << n;
    before = found;
  }
}

}  // namespace
}  // namespace isostar
