// The checks of headers and layers: known values, and every error of one and of two bits.
#include "container/crc.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace isostar {
namespace {

std::vector<std::byte> bytesOf(std::string_view text) {
  std::vector<std::byte> bytes;
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

template <class Check>
auto sumOf(std::span<const std::byte> bytes) {
  Check crc;
  crc.add(bytes);
  return crc.sum();
}

TEST(Crc, hasTheKnownCheckValue) {
  // CRC-16/CCITT-FALSE, as catalogues list it.
  EXPECT_EQ(sumOf<Crc16>(bytesOf("123456789")), 0x29B1);
}

TEST(Crc, ofNothingIsTheInitialValue) {
  EXPECT_EQ(sumOf<Crc16>({}), 0xFFFF);
  EXPECT_EQ(sumOf<Crc32>({}), 0xFFFFFFFFu);
}

template <class Check>
void findsOneAndTwoBits(std::size_t length) {
  std::vector<std::byte> bytes(length);
  for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<std::byte>(i * 37 + 11);
  const auto sum = sumOf<Check>(bytes);
  const auto flip = [&](std::size_t bit) {
    bytes[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
  };
  for (std::size_t a = 0; a < 8 * length; ++a) {
    flip(a);
    EXPECT_NE(sumOf<Check>(bytes), sum) << a;
    for (std::size_t b = a + 1; b < 8 * length; ++b) {
      flip(b);
      EXPECT_NE(sumOf<Check>(bytes), sum) << a << ", " << b;
      flip(b);
    }
    flip(a);
  }
}

TEST(Crc, findsEveryErrorOfOneOrTwoBits) {
  findsOneAndTwoBits<Crc16>(60);
  findsOneAndTwoBits<Crc32>(60);
}

}  // namespace
}  // namespace isostar
