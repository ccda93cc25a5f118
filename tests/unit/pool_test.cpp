#include "util/pool.h"

#include <gtest/gtest.h>

#include <string>

namespace isostar {
namespace {

TEST(Pool, keepsTheAddressesOfItsItems) {
  Pool<std::string> pool;
  pool.add("first");
  const std::string* const first = &pool[0];
  for (int i = 1; i < 1000; ++i) pool.add(std::to_string(i));
  EXPECT_EQ(pool.size(), 1000u);
  EXPECT_EQ(&pool[0], first);
  EXPECT_EQ(*first, "first");
  EXPECT_EQ(pool[999], "999");
}

TEST(Pool, copiesItsItems) {
  Pool<std::string> pool;
  pool.add("original");
  Pool<std::string> copy = pool;
  copy[0] = "changed";
  copy.add("added");
  EXPECT_EQ(pool[0], "original");
  EXPECT_EQ(pool.size(), 1u);
  pool = copy;
  copy[0] = "changed again";
  EXPECT_EQ(pool[0], "changed");
  EXPECT_EQ(pool.size(), 2u);
}

TEST(Pool, keepsTheAddressesOfItsItemsWhenMoved) {
  Pool<std::string> pool;
  pool.add("moved");
  const std::string* const item = &pool[0];
  Pool<std::string> other;
  other = std::move(pool);
  EXPECT_EQ(&other[0], item);
}

}  // namespace
}  // namespace isostar
