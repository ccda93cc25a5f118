#include "container/header.h"

#include <gtest/gtest.h>

#include "container/stream.h"

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

TEST(Header, roundTrips) {
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

TEST(Header, takesFewBytesForASmallImage) {
  EXPECT_LE(written(small()).size(), 18u);
}

TEST(Header, hasAsFewLevelsAsTheBaseAllows) {
  Header h;
  for (const auto& [side, finestLevel] :
       {std::pair{1, 0}, {5, 0}, {6, 1}, {9, 1}, {10, 2}, {(1 << 28) - 1, 26}}) {
    h.size = {2, side, 3, 1};
    EXPECT_EQ(h.finestLevel(), finestLevel) << side;
    EXPECT_LE(h.base<3>().last[1], Header::kMostBaseCells);
  }
}

TEST(Header, holdsDistantIsovalues) {
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

TEST(Header, everyPrefixIsTruncated) {
  const Bytes bytes = written(full());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const Bytes prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    Header back;
    std::size_t used = 77;
    EXPECT_EQ(read(prefix, back, used), Error::Truncated) << length;
    EXPECT_EQ(used, 77u);
  }
}

TEST(Header, everyChangedBitIsDetected) {
  Bytes bytes = written(full());
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    Header back;
    std::size_t used = 0;
    EXPECT_NE(read(bytes, back, used), Error::None) << "bit " << bit;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

TEST(Header, sizesOutOfRangeAreCorrupt) {
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

TEST(Header, aFifthDimensionIsAnUnsupportedVersion) {
  Bytes bytes = written(full());
  bytes[3] |= std::byte{3};
  Header back;
  std::size_t used = 0;
  EXPECT_EQ(read(bytes, back, used), Error::UnsupportedVersion);
}

}  // namespace
}  // namespace isostar
