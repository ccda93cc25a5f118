#include <gtest/gtest.h>

#include "product_sum.h"

namespace isostar::native {
namespace {

TEST(Contraction, productsAreRoundedBeforeSums) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP();
#endif
  const double a = 1 + 0x1p-30;
  EXPECT_EQ(productSum(a, a, -(1 + 0x1p-29)), 0) << "a fused operation gives 2^-60";
}

}  // namespace
}  // namespace isostar::native
