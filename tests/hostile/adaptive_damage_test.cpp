// Adaptive streams with changed bits and repaired checksums.
#include "flipped_bits.h"

namespace isostar {
namespace {

TEST(AdaptiveDamage, isHarmlessWithRepairedChecksums) {
  const auto field = sampled("ball", {80, 72, 84}, [](double x, double y, double z) {
    return 30 - std::sqrt((x - 39) * (x - 39) + (y - 35) * (y - 35) + (z - 41) * (z - 41));
  });
  EncodeOptions options;
  options.maxError = 0.4;
  options.adaptive = true;
  const Bytes good = encoded(field, options);
  StreamInfo info;
  ASSERT_EQ(inspect(good, info), Error::None);
  ASSERT_TRUE(info.adaptive);
  expectHarmlessFlips(good, 293);
}

TEST(AdaptiveDamage, isHarmlessInFittedScalars) {
  const Size size{24, 24, 24};
  EncodeOptions options;
  options.maxError = 1;
  options.adaptive = true;
  options.effort = 2;
  const Bytes good = encoded(sampled("ball", size, sphere(size, 0.45)), options);
  const StreamLayout layout(good);
  ASSERT_TRUE(layout.header.adaptive && layout.header.fitted);
  expectHarmlessFlips(good, 7);
}

TEST(AdaptiveDamage, isHarmlessInStreamsThatPreserveTopology) {
  EncodeOptions options;
  options.preserveTopology = true;
  const Bytes good = encoded(sampled("gyroid", {40, 33, 36}, gyroid(14)), options);
  const StreamLayout layout(good);
  ASSERT_TRUE(layout.header.keepsTopology);
  // Every bit of the signs, then samples of the whole stream.
  expectHarmlessFlips(
      Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(layout.layers[3].end)), 53);
  expectHarmlessFlips(good, 997);
}

}  // namespace
}  // namespace isostar
