// Headers and layer heads with impossible or excessive values.
#include <limits>

#include "harmless.h"
#include "stream_layout.h"

namespace isostar {
namespace {

Header plausible() {
  Header header;
  header.size = {9, 9, 9, 1};
  return header;
}

Error errorOf(const Bytes& bytes, const Limits& limits = kTight) {
  return harmlesslyDecoded(bytes, limits).error();
}
Error errorOf(const Header& header, const Limits& limits = kTight) {
  return errorOf(assembled(header, {}), limits);
}

Bytes bytesOf(const std::string& text) {
  Bytes bytes;
  for (char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

TEST(HostileHeader, aPlausibleHeaderIsAccepted) {
  EXPECT_EQ(errorOf(plausible()), Error::None);
}

TEST(HostileHeader, foreignFilesAreRefused) {
  for (const char* text : {"DRACO", "\x89PNG\r\n", "ply\n", "isn't ours", "<!DOCTYPE html>"})
    EXPECT_EQ(errorOf(bytesOf(text)), Error::NotIsostar) << text;
  EXPECT_EQ(errorOf(bytesOf("is")), Error::Truncated);
  EXPECT_EQ(errorOf(Bytes{}), Error::Truncated);
  EXPECT_EQ(errorOf(bytesOf("iso\x85")), Error::Truncated);
}

TEST(HostileHeader, otherVersionsAreRefused) {
  Bytes bytes = encoded(sampled("sphere", {9, 9, 9}, sphere({9, 9, 9})));
  const StreamLayout layout(bytes);
  for (int version = 0; version < 32; ++version) {
    if (version == kFormatVersion) continue;
    bytes[3] = static_cast<std::byte>(0x80 | version << 2 | 1);
    const Error expected = version == 0 ? Error::Corrupt : Error::UnsupportedVersion;
    EXPECT_EQ(errorOf(bytes), expected);
    EXPECT_EQ(errorOf(repaired(bytes, layout)), expected);
    StreamInfo info;
    EXPECT_EQ(inspect(bytes, info), expected);
  }
}

TEST(HostileHeader, sizesBeyondTheLimitsAreRefused) {
  for (const Size& size : {Size{1 << 20, 1 << 20, 1}, Size{1 << 27, 1 << 27, 1 << 27},
                           Size{(1 << 28) - 1, (1 << 28) - 1, (1 << 28) - 1},
                           Size{1, 1, (1 << 28) - 1}, Size{2048, 2048, 2}}) {
    Header header = plausible();
    header.size = {size[0], size[1], size[2], 1};
    EXPECT_EQ(errorOf(header), Error::OverLimit) << testing::PrintToString(size);
  }
}

TEST(HostileHeader, moreVerticesThanTheLimitsAreRefused) {
  Header header = plausible();
  header.vertices = kTight.vertices + 1;
  EXPECT_EQ(errorOf(header), Error::OverLimit);
  header.vertices = uint64_t{1} << 62;
  EXPECT_EQ(errorOf(header), Error::OverLimit);
}

TEST(HostileHeader, sizesOfOtherDimensionsAreLimited) {
  Header header = plausible();
  header.dimension = 4;
  header.size = {1 << 10, 1 << 10, 1 << 10, (1 << 28) - 1};
  EXPECT_EQ(errorOf(header), Error::OverLimit);
  header.size = {9, 9, 9, 9};
  EXPECT_EQ(errorOf(header), Error::None);
  header.dimension = 2;
  EXPECT_EQ(errorOf(header), Error::None);
  header.size = {(1 << 28) - 1, (1 << 28) - 1, 1, 1};
  EXPECT_EQ(errorOf(header), Error::OverLimit);
}

TEST(HostileHeader, numbersOutOfRangeAreCorrupt) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (double bad : {nan, infinity, -infinity}) {
    std::vector<Header> headers(5, plausible());
    headers[0].isovalue = bad;
    headers[1].maxError = -std::abs(bad);
    headers[2].placement.spacing[0] = bad;
    headers[3].placement.origin[1] = bad;
    headers[4].placement.direction[5] = bad;
    for (std::size_t i = 0; i < headers.size(); ++i)
      EXPECT_EQ(errorOf(headers[i]), Error::Corrupt) << i << ": " << bad;
  }
  for (double bad : {0.0, -1.0}) {
    Header header = plausible();
    header.placement.spacing[2] = bad;
    EXPECT_EQ(errorOf(header), Error::Corrupt);
  }
  for (double bad : {0x1p1000, 0x1p-1000}) {
    Header header = plausible();
    header.quantizationStep = bad;
    EXPECT_EQ(errorOf(header), Error::Corrupt);
  }
  Header flat = plausible();
  flat.placement.direction = {1, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(errorOf(flat), Error::Corrupt);
}

TEST(HostileHeader, impossibleFurtherIsovaluesAreCorrupt) {
  Header header = plausible();
  header.furtherIsovalues = {1, 2};
  EXPECT_EQ(errorOf(header), Error::None);
  header.furtherIsovalues = {1, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(errorOf(header), Error::Corrupt);
  header.furtherIsovalues = std::vector<double>(15, 1.0);
  EXPECT_EQ(errorOf(header), Error::None);
  header.furtherIsovalues.push_back(1);
  EXPECT_EQ(errorOf(header), Error::Corrupt);
  header.furtherIsovalues = {1};
  header.adaptive = true;
  EXPECT_EQ(errorOf(header), Error::Corrupt);
}

TEST(HostileHeader, layersOfIsovaluesOutOfOrderAreCorrupt) {
  const auto field = sampled("sphere", {9, 9, 9}, sphere({9, 9, 9}));
  EncodeOptions options;
  options.furtherIsovalues = {0.3, 0.5};
  const Bytes good = encoded(field, options);
  const StreamLayout layout(good);
  const Layers layers = layersOf(good, layout);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    for (int number = 0; number < 4; ++number) {
      auto other = layers;
      other[i].first.level = number;
      (void)errorOf(assembled(layout.header, other));
      other[i].first.kind = number % 2 == 0 ? LayerKind::FurtherSigns : LayerKind::FurtherGeometry;
      (void)errorOf(assembled(layout.header, other));
    }
    auto early = layers;
    std::swap(early[0], early[i]);
    EXPECT_EQ(errorOf(assembled(layout.header, early)), i > 0 ? Error::Corrupt : Error::None) << i;
  }
}

TEST(HostileHeader, layersOutOfOrderAreHarmless) {
  const auto field = sampled("sphere", {20, 20, 20}, sphere({20, 20, 20}));
  const Bytes good = encoded(field);
  const StreamLayout layout(good);
  const Layers layers = layersOf(good, layout);
  ASSERT_EQ(assembled(layout.header, layers), good);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    auto missing = layers, twice = layers, swapped = layers;
    missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(i));
    (void)errorOf(assembled(layout.header, missing));
    twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(i), layers[i]);
    (void)errorOf(assembled(layout.header, twice));
    std::swap(swapped[i], swapped[(i + 1) % layers.size()]);
    (void)errorOf(assembled(layout.header, swapped));
    if (layout.heads[i].level == layout.header.finestLevel() && i > 0 &&
        layout.heads[i - 1].level == layout.header.finestLevel())
      continue;
    EXPECT_EQ(errorOf(assembled(layout.header, twice)), Error::Corrupt)
        << "layer " << i << " twice";
  }
  for (int kind = 0; kind < 4; ++kind) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
      auto other = layers;
      other[i].first.kind = static_cast<LayerKind>(kind);
      (void)errorOf(assembled(layout.header, other));
    }
  }
}

TEST(HostileHeader, aHugeLayerIsTruncatedOrCorrupt) {
  Header header = plausible();
  header.bytes = (uint64_t{1} << 62) + 100;
  Bytes bytes;
  ByteWriter out(bytes);
  write(out, header);
  LayerHead head;
  for (uint64_t length : {uint64_t{1} << 20, uint64_t{1} << 40, uint64_t{1} << 62}) {
    Bytes endless = bytes;
    ByteWriter writer(endless);
    head.bytes = length;
    write(writer, head);
    EXPECT_EQ(errorOf(endless), Error::Truncated);
    StreamInfo info;
    EXPECT_EQ(inspect(endless, info), Error::None);
  }
  head.bytes = header.bytes;
  ByteWriter writer(bytes);
  write(writer, head);
  EXPECT_EQ(errorOf(bytes), Error::Corrupt) << "longer than the stream";
}

TEST(HostileHeader, tooManyLayersAreCorrupt) {
  Layers layers(1000, {LayerHead{}, Bytes(4)});
  for (std::size_t i = 1; i < layers.size(); ++i) layers[i].first.kind = LayerKind::Exponents;
  const Bytes bytes = assembled(plausible(), layers);
  EXPECT_EQ(errorOf(bytes), Error::Corrupt);
  StreamInfo info;
  EXPECT_EQ(inspect(bytes, info), Error::Corrupt);
}

}  // namespace
}  // namespace isostar
