// Adaptive streams with changed bits and repaired checksums.
#include "harmless.h"
#include "stream_layout.h"

namespace isostar {
namespace {

void expectHarmless(const Bytes& good, std::size_t stride) {
  const StreamLayout layout(good);
  Bytes bytes = good;
  for (std::size_t bit = 0; bit < 8 * good.size(); bit += stride) {
    SCOPED_TRACE("bit " + std::to_string(bit % 8) + " of byte " + std::to_string(bit / 8));
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    (void)harmlesslyDecoded(repaired(bytes, layout));
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

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
  expectHarmless(good, 293);
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
  expectHarmless(good, 7);
}

TEST(AdaptiveDamage, isHarmlessInStreamsThatPreserveTopology) {
  EncodeOptions options;
  options.preserveTopology = true;
  const Bytes good = encoded(sampled("gyroid", {40, 33, 36}, gyroid(14)), options);
  const StreamLayout layout(good);
  ASSERT_TRUE(layout.header.keepsTopology);
  // Every bit of the signs, then samples of the whole stream.
  expectHarmless(
      Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(layout.layers[3].end)), 53);
  expectHarmless(good, 997);
}

}  // namespace
}  // namespace isostar
