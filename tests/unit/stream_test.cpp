#include "container/stream.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

using Bytes = std::vector<std::byte>;

template <class T>
Bytes written(const T& value) {
  Bytes bytes;
  ByteWriter out(bytes);
  write(out, value);
  return bytes;
}

TEST(LayerHead, roundTrips) {
  Header header;
  header.size = {129, 1, 1, 1};
  for (uint64_t length : {uint64_t{0}, uint64_t{127}, uint64_t{128}, (uint64_t{1} << 63) - 1}) {
    const LayerHead head{.kind = LayerKind::Magnitudes,
                         .level = 5,
                         .error = 0.01,
                         .bytes = length,
                         .checksum = length < 1024 ? 0xBEEF : 0xDEADBEEF};
    const Bytes bytes = written(head);
    LayerHead back;
    std::size_t used = 0;
    ASSERT_EQ(read(bytes, header, back, used), Error::None);
    EXPECT_EQ(used, bytes.size());
    EXPECT_EQ(back.kind, head.kind);
    EXPECT_EQ(back.level, head.level);
    EXPECT_EQ(back.bytes, head.bytes);
    EXPECT_EQ(back.checksum, head.checksum);
    EXPECT_NEAR(back.error, head.error, 0.05 * head.error);
    for (std::size_t prefix = 0; prefix < bytes.size(); ++prefix) {
      EXPECT_EQ(read(std::span(bytes).first(prefix), header, back, used), Error::Truncated);
    }
  }
}

TEST(LayerHead, keepsErrorsToFivePercent) {
  Header header;
  for (double error = 2e-6; error < 900; error *= 1.37) {
    LayerHead back;
    std::size_t used = 0;
    ASSERT_EQ(read(written(LayerHead{.error = error}), header, back, used), Error::None);
    EXPECT_NEAR(back.error, error, 0.05 * error);
  }
  LayerHead none;
  std::size_t used = 0;
  ASSERT_EQ(read(written(LayerHead{}), header, none, used), Error::None);
  EXPECT_EQ(none.error, 0);
}

TEST(LayerHead, isCorruptWithALevelThatTheHeaderLacks) {
  Header header;
  header.size = {17, 1, 1, 1};
  LayerHead back;
  std::size_t used = 0;
  EXPECT_EQ(read(written(LayerHead{.kind = LayerKind::Refinement, .level = 3}), header, back, used),
            Error::Corrupt);
}

TEST(Checksum, coversTheHeadAndTheNumberOfALayer) {
  const Bytes layer(2000, std::byte{7});
  for (const std::size_t length : {std::size_t{10}, layer.size()}) {
    const auto bytes = std::span(layer).first(length);
    const LayerHead head{.kind = LayerKind::Refinement, .level = 3, .error = 0.25, .bytes = length};
    const uint32_t sum = checksum(head, bytes, 4);
    EXPECT_EQ(sum < 0x10000, length == 10);
    LayerHead kind = head, level = head, error = head, longer = head;
    kind.kind = LayerKind::Exponents;
    level.level = 4;
    error.error = 0.3;
    longer.bytes += 1;
    for (const LayerHead& other : {kind, level, error, longer})
      EXPECT_NE(checksum(other, bytes, 4), sum);
    EXPECT_NE(checksum(head, bytes, 5), sum);
  }
}

}  // namespace
}  // namespace isostar
