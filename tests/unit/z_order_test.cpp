#include "grid/z_order.h"

#include <gtest/gtest.h>

#include <set>

namespace isostar {
namespace {

TEST(ZOrder, interleavesTheBitsOfPlacesInACube) {
  const ZOrder<3> order({8, 8, 8});
  ASSERT_EQ(order.total(), 512u);
  for (std::size_t number = 0; number < 512; ++number) {
    Coordinates<3> place{};
    for (std::size_t bit = 0; bit < 9; ++bit)
      place[bit % 3] |= static_cast<int32_t>(number >> bit & 1) << bit / 3;
    EXPECT_EQ(order.place(number), place);
    EXPECT_EQ(order.number(place), number);
  }
}

TEST(ZOrder, leavesOutPlacesBeyondTheBox) {
  for (const Coordinates<3>& count :
       {Coordinates<3>{1, 1, 1}, {5, 3, 2}, {1, 7, 1}, {9, 9, 7}, {2, 1, 3}}) {
    const ZOrder<3> order(count), cube({16, 16, 16});
    std::size_t before = 0;
    std::set<Coordinates<3>> places;
    for (std::size_t number = 0; number < order.total(); ++number) {
      const auto place = order.place(number);
      for (std::size_t a = 0; a < 3; ++a) ASSERT_TRUE(place[a] >= 0 && place[a] < count[a]);
      EXPECT_EQ(order.number(place), number);
      EXPECT_TRUE(number == 0 || cube.number(place) > before);
      before = cube.number(place);
      places.insert(place);
    }
    EXPECT_EQ(places.size(), order.total());
  }
}

TEST(ZOrder, isTheOrderOfALineInOneDimension) {
  const ZOrder<3> order({1, 1, 1000});
  for (int32_t at = 0; at < 1000; ++at)
    EXPECT_EQ(order.place(static_cast<std::size_t>(at)), (Coordinates<3>{0, 0, at}));
}

}  // namespace
}  // namespace isostar
