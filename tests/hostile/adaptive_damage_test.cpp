// Adaptive streams with changed bits behind right checksums.
#include "anatomy.h"
#include "harmless.h"

namespace isostar {
namespace {

TEST(AdaptiveDamage, behindRightChecksumsItIsHarmless) {
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
  const Anatomy anatomy(good);
  Bytes bytes = good;
  for (std::size_t bit = 0; bit < 8 * good.size(); bit += 293) {
    SCOPED_TRACE("bit " + std::to_string(bit % 8) + " of byte " + std::to_string(bit / 8));
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    (void)harmlesslyDecoded(repaired(bytes, anatomy));
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

}  // namespace
}  // namespace isostar
