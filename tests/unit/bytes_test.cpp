#include "container/bytes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isostar {
namespace {

std::vector<std::byte> bytesOf(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (int v : values) bytes.push_back(static_cast<std::byte>(v));
  return bytes;
}

TEST(Bytes, varintsOfEachLengthRoundTrip) {
  for (int bits = 0; bits < 63; ++bits) {
    for (uint64_t v : {(uint64_t{1} << bits) - 1, uint64_t{1} << bits, (uint64_t{1} << bits) + 1}) {
      if (v >> 63 != 0) continue;
      std::vector<std::byte> out;
      ByteWriter(out).varint(v);
      EXPECT_LE(out.size(), 9u);
      ByteReader in(out);
      EXPECT_EQ(in.varint(), v);
      EXPECT_EQ(in.position(), out.size());
      EXPECT_FALSE(in.overrun() || in.malformed());
    }
  }
}

TEST(Bytes, varintHasNoMoreThanNineBytes) {
  const std::vector<std::byte> endless(20, std::byte{0x80});
  ByteReader in(endless);
  EXPECT_EQ(in.varint(), 0u);
  EXPECT_TRUE(in.malformed());
  EXPECT_EQ(in.position(), 9u);
}

TEST(Bytes, areLittleEndian) {
  std::vector<std::byte> out;
  ByteWriter w(out);
  w.u8(0xFE);
  w.u32(0x04030201u);
  EXPECT_EQ(out, bytesOf({0xFE, 1, 2, 3, 4}));
  ByteReader in(out);
  EXPECT_EQ(in.u8(), 0xFEu);
  EXPECT_EQ(in.u32(), 0x04030201u);
}

TEST(Bytes, floatsKeepEveryBit) {
  for (double v : {0.0, -0.0, 0.1, -1e300, 5e-324, std::numeric_limits<double>::infinity()}) {
    std::vector<std::byte> out;
    ByteWriter w(out);
    w.f64(v);
    w.f32(static_cast<float>(v));
    ByteReader in(out);
    const double back = in.f64();
    EXPECT_EQ(std::bit_cast<uint64_t>(back), std::bit_cast<uint64_t>(v));
    EXPECT_EQ(std::bit_cast<uint32_t>(in.f32()), std::bit_cast<uint32_t>(static_cast<float>(v)));
  }
}

TEST(Bytes, readsZerosPastTheEndAndReportsIt) {
  const auto three = bytesOf({1, 2, 3});
  ByteReader in(three);
  EXPECT_EQ(in.u32(), 0x00030201u);
  EXPECT_TRUE(in.overrun());
  EXPECT_EQ(in.position(), 3u);
  EXPECT_EQ(in.f64(), 0.0);
  EXPECT_EQ(in.varint(), 0u);
  EXPECT_FALSE(in.malformed());
}

TEST(Bytes, reportsTheOverrunOfAnEmptyInput) {
  ByteReader in{std::span<const std::byte>()};
  EXPECT_FALSE(in.overrun());
  EXPECT_EQ(in.u8(), 0u);
  EXPECT_TRUE(in.overrun());
}

TEST(Bytes, realNumbersRoundTrip) {
  const double third = 1.0 / 3;
  for (double v : {0.0, 0.5, -0.05, 500.5, 127.5, 1e9, -1e20, third, 1e-30, 0.957031, double{0.1F},
                   123456.7890123, 0x1p60}) {
    std::vector<std::byte> bytes;
    ByteWriter(bytes).real(v);
    ByteReader in(bytes);
    EXPECT_EQ(in.real(), v);
    EXPECT_EQ(in.position(), bytes.size());
    EXPECT_FALSE(in.overrun());
  }
}

TEST(Bytes, shortDecimalsAreShort) {
  auto length = [](double v) {
    std::vector<std::byte> bytes;
    ByteWriter(bytes).real(v);
    return bytes.size();
  };
  EXPECT_EQ(length(0.5), 1u);
  EXPECT_EQ(length(0.05), 1u);
  EXPECT_EQ(length(30.5), 2u);
  EXPECT_EQ(length(500.5), 3u);
  EXPECT_EQ(length(double{0.1F}), 5u);
  EXPECT_EQ(length(1.0 / 3), 9u);
}

TEST(Bytes, smallNumbersOfEitherSignAreShort) {
  for (int64_t v : {int64_t{0}, int64_t{-1}, int64_t{63}, int64_t{-64}, int64_t{1} << 40,
                    -(int64_t{1} << 40)}) {
    std::vector<std::byte> bytes;
    ByteWriter(bytes).zigzag(v);
    EXPECT_EQ(ByteReader(bytes).zigzag(), v);
    EXPECT_EQ(bytes.size() == 1, v >= -64 && v < 64);
  }
}

}  // namespace
}  // namespace isostar
