#include "grid/brick_map.h"

#include <gtest/gtest.h>

#include <random>

namespace isostar {
namespace {

using Slots = BrickMap<uint32_t, 0, 1>;
constexpr std::size_t kPage = Slots::kPage;

TEST(BrickMap, readsWhatWasSet) {
  constexpr std::size_t kSize = 10 * kPage + 7;
  Slots map(kSize);
  std::vector<uint32_t> expected(kSize, 0);
  std::mt19937 random(1);
  for (int i = 0; i < 3000; ++i) {
    const std::size_t at = random() % kSize;
    const uint32_t number = random() % 5;
    map.set(at, number);
    expected[at] = number;
    if (i % 1000 == 999) {
      map.fill(1);
      std::fill(expected.begin(), expected.end(), 1);
    }
    ASSERT_EQ(map[at], expected[at]);
  }
  ASSERT_EQ(map.size(), kSize);
  for (std::size_t at = 0; at < kSize; ++at) EXPECT_EQ(map[at], expected[at]) << at;
}

TEST(BrickMap, commonNumbersTakeNoPages) {
  Slots map(4 * kPage);
  const uint64_t empty = map.memory();
  EXPECT_EQ(map.varied(), 0u);
  for (std::size_t at = kPage; at < 3 * kPage; ++at) map.set(at, 1);
  EXPECT_EQ(map.memory(), empty);
  EXPECT_EQ(map.varied(), 2u);  // where 0 and 1 meet
  map.set(5, 7);
  map.set(kPage, 7);
  EXPECT_EQ(map.memory(), empty + 2 * Slots::kBytesPerPage);
  EXPECT_EQ(map.varied(), 3u);
  EXPECT_LE(map.memory(), Slots::memoryOf(map.size(), 2));
  EXPECT_EQ(map.memoryToSet(), map.memory() + Slots::kBytesPerPage);
  map.fill(0);
  EXPECT_EQ(map.memory(), empty);
}

TEST(BrickMap, copiesAreIndependent) {
  Slots map(2 * kPage);
  map.set(3, 9);
  Slots copy = map;
  copy.set(3, 4);
  copy.set(kPage, 8);
  EXPECT_EQ(map[3], 9u);
  EXPECT_EQ(map[kPage], 0u);
  Slots moved = std::move(copy);
  EXPECT_EQ(moved[3], 4u);
  moved = map;
  EXPECT_EQ(moved[3], 9u);
  EXPECT_EQ(moved.memory(), map.memory());
  map = {};
  EXPECT_EQ(map.size(), 0u);
  EXPECT_EQ(moved[3], 9u);
}

TEST(BrickMap, ofOneCommonNumber) {
  BrickMap<uint8_t, 255> map(5);
  EXPECT_EQ(map[4], 255);
  map.set(4, 0);
  EXPECT_EQ(map[4], 0);
  EXPECT_EQ(map[0], 255);
}

}  // namespace
}  // namespace isostar
