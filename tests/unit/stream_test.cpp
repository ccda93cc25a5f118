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

void expectEqual(const Header& a, const Header& b) {
  EXPECT_EQ(a.dimension, b.dimension);
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.placement.origin, b.placement.origin);
  EXPECT_EQ(a.placement.spacing, b.placement.spacing);
  EXPECT_EQ(a.placement.direction, b.placement.direction);
  EXPECT_EQ(a.isovalue, b.isovalue);
  EXPECT_EQ(a.polygonizer, b.polygonizer);
  EXPECT_EQ(a.lossless, b.lossless);
  EXPECT_EQ(a.maxError, b.maxError);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.quantizationStep, b.quantizationStep);
  EXPECT_EQ(a.positiveOffset, b.positiveOffset);
  EXPECT_EQ(a.negativeOffset, b.negativeOffset);
  EXPECT_EQ(a.whole, b.whole);
  EXPECT_EQ(a.bytes, b.bytes);
}

Header full() {
  Header h;
  h.size = {1, (1 << 28) - 1, 300, 1};
  h.placement.origin = {-1.5, 1e9, 0.1};
  h.placement.spacing = {1e-3, 2, 1e3};
  h.placement.direction = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  h.isovalue = -1234.5;
  h.polygonizer = Polygonizer::Tetrahedra;
  h.lossless = true;
  h.vertices = uint64_t{1} << 40;
  h.quantizationStep = 0.125;
  h.bytes = uint64_t{1} << 50;
  return h;
}

Header small() {
  Header h;
  h.dimension = 2;
  h.size = {256, 256, 1, 1};
  h.isovalue = 0.5;
  h.maxError = 0.05;
  h.vertices = 1000;
  h.bytes = 2000;
  h.countWhole(Header::kByteStep);
  return h;
}

TEST(Header, comesBack) {
  Header whole;
  whole.size = {2, 3, 4, 1};
  whole.isovalue = 99.25;
  whole.maxError = 0.05;
  whole.countWhole(1);
  EXPECT_EQ(whole.positiveOffset, 0.75);
  EXPECT_EQ(whole.negativeOffset, 0.25);
  Header sequence = full();
  sequence.dimension = 4;
  sequence.size[3] = 12;
  Header stretched = small();
  stretched.placement.spacing = {2, 0.1, 0.1};
  stretched.placement.origin = {-1, 1.0 / 3, 0};
  for (const Header& header : {whole, full(), small(), stretched, sequence}) {
    const Bytes bytes = written(header);
    Header back;
    std::size_t used = 0;
    ASSERT_EQ(read(bytes, back, used), Error::None);
    EXPECT_EQ(used, bytes.size());
    expectEqual(back, header);
  }
}

TEST(Header, ofASmallImageIsSmall) {
  EXPECT_LE(written(small()).size(), 18u);
}

TEST(Header, asFewOctavesAsTheBaseAllows) {
  Header h;
  for (const auto& [side, finestLevel] :
       {std::pair{1, 0}, {5, 0}, {6, 1}, {9, 1}, {10, 2}, {(1 << 28) - 1, 26}}) {
    h.size = {2, side, 3, 1};
    EXPECT_EQ(h.finestLevel(), finestLevel) << side;
    EXPECT_LE(h.base<3>().last[1], Header::kMostBaseCells);
  }
}

TEST(Header, farIsovaluesHaveOffsetsAndShifts) {
  for (const double step : {1.0, Header::kByteStep}) {
    for (const double isovalue : {1e308, -1e308}) {
      Header h;
      h.isovalue = isovalue;
      h.countWhole(step);
      EXPECT_EQ(h.positiveOffset, 1);
      EXPECT_EQ(h.negativeOffset, 0);
      EXPECT_EQ(h.shift(isovalue), 0);
      EXPECT_EQ(h.shift(0), isovalue > 0 ? -Header::kFarSteps : Header::kFarSteps);
      EXPECT_EQ(h.shift(-isovalue), h.shift(0));
    }
  }
}

TEST(Header, eachPrefixIsTruncated) {
  const Bytes bytes = written(full());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const Bytes prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    Header back;
    std::size_t used = 77;
    EXPECT_EQ(read(prefix, back, used), Error::Truncated) << length;
    EXPECT_EQ(used, 77u);
  }
}

TEST(Header, eachChangedBitIsNoticed) {
  Bytes bytes = written(full());
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    Header back;
    std::size_t used = 0;
    EXPECT_NE(read(bytes, back, used), Error::None) << "bit " << bit;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

TEST(Header, fieldsAtTheirBounds) {
  auto errorOf = [](const Header& header) {
    Header back;
    std::size_t used = 0;
    return read(written(header), back, used);
  };
  Header header = full();
  header.size[1] = 1 << 28;
  EXPECT_EQ(errorOf(header), Error::Corrupt);
  header.size[1] = 0;
  EXPECT_EQ(errorOf(header), Error::Corrupt);
  header = small();
  header.size[0] = 0;
  EXPECT_EQ(errorOf(header), Error::Corrupt);
  header = full();
  header.dimension = 4;
  header.size[3] = 0;
  EXPECT_EQ(errorOf(header), Error::Corrupt);
}

TEST(Header, aFifthDimensionIsOfALaterVersion) {
  Bytes bytes = written(full());
  bytes[3] |= std::byte{3};
  Header back;
  std::size_t used = 0;
  EXPECT_EQ(read(bytes, back, used), Error::UnsupportedVersion);
}

TEST(LayerHead, comesBack) {
  Header header;
  header.size = {129, 1, 1, 1};
  for (uint64_t length : {uint64_t{0}, uint64_t{127}, uint64_t{128}, (uint64_t{1} << 63) - 1}) {
    const LayerHead head{LayerKind::Magnitudes, 5, 0.01, length,
                         length < 1024 ? 0xBEEF : 0xDEADBEEF};
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

TEST(LayerHead, errorsKeepFivePercent) {
  Header header;
  for (double error = 2e-6; error < 900; error *= 1.37) {
    LayerHead back;
    std::size_t used = 0;
    ASSERT_EQ(read(written(LayerHead{LayerKind::Base, 0, error, 0, 0}), header, back, used),
              Error::None);
    EXPECT_NEAR(back.error, error, 0.05 * error);
  }
  LayerHead none;
  std::size_t used = 0;
  ASSERT_EQ(read(written(LayerHead{}), header, none, used), Error::None);
  EXPECT_EQ(none.error, 0);
}

TEST(LayerHead, aLevelThatTheHeaderLacksIsCorrupt) {
  Header header;
  header.size = {17, 1, 1, 1};
  LayerHead back;
  std::size_t used = 0;
  EXPECT_EQ(read(written(LayerHead{LayerKind::Refinement, 3, 0, 0, 0}), header, back, used),
            Error::Corrupt);
}

TEST(Checksum, isThatOfXxHash32) {
  EXPECT_EQ(checksum({}), 0x5D05u);
}

TEST(Checksum, ofALayerCoversItsHead) {
  const Bytes layer(2000, std::byte{7});
  const LayerHead head{LayerKind::Refinement, 3, 0.25, layer.size(), 0};
  for (const std::size_t length : {std::size_t{10}, layer.size()}) {
    const auto bytes = std::span(layer).first(length);
    const uint32_t sum = checksum(head, bytes);
    EXPECT_EQ(sum < 0x10000, length == 10);
    for (const LayerHead& other :
         {LayerHead{LayerKind::Exponents, 3, 0.25}, LayerHead{LayerKind::Refinement, 4, 0.25},
          LayerHead{LayerKind::Refinement, 3, 0.3}}) {
      EXPECT_NE(checksum(other, bytes), sum);
    }
  }
}

}  // namespace
}  // namespace isostar
