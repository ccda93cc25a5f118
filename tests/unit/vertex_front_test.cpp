#include "grid/vertex_front.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

const Coordinates<2> kBox{20, 13};
const Lattice<2> kLattice(kBox, 1);

Signs<2> signsOf(const DenseSigns<2>::Positive& positive) {
  return DenseSigns<2>(kLattice, positive).bricks();
}

bool isOpen(const VertexFront<2>& front, const BrickTable<2>& table, const Coordinates<2>& v) {
  return (front.openRow(table.brickIndexOf(v), static_cast<std::size_t>(v[1] & 7)) >> (v[0] & 7) &
          1) != 0;
}

TEST(VertexFront, opensTheVerticesBetweenTwoSurfaces) {
  const auto below = signsOf([](const auto&v) { return v[0] > 3; }),
             above = signsOf([](const auto&v) { return v[0] > 9; });
  auto signs = above;
  VertexFront<2> front;
  front.begin(signs, &below, &above);
  forVertices(kLattice, [&](const Coordinates<2>& v) {
    EXPECT_EQ(isOpen(front, signs.table(), v), v[0] > 3 && v[0] <= 9);
  });
  front.begin(signs, nullptr, nullptr);
  forVertices(kLattice,
              [&](const Coordinates<2>& v) { EXPECT_TRUE(isOpen(front, signs.table(), v)); });
  EXPECT_EQ(front.openRow(2, 0), 0x1Fu) << "vertices beyond the lattice are closed";
}

TEST(VertexFront, findsOpenVerticesBesideTheOtherSign) {
  auto signs = signsOf([](const auto& v) { return v == Coordinates<2>{8, 5}; });
  VertexFront<2> front;
  front.begin(signs, nullptr, nullptr);
  for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
    front.enter(brickIndex);
    for (std::size_t r = 0; r < kBrickSide; ++r) {
      for (int x = 0; x < kBrickSide; ++x) {
        const auto v = vertexOf<2>(signs.table().brick(brickIndex),
                                   r * kBrickSide + static_cast<std::size_t>(x));
        const int32_t distance = std::abs(v[0] - 8) + std::abs(v[1] - 5);
        EXPECT_EQ((front.beside(brickIndex, r) >> x & 1) != 0, distance <= 1)
            << testing::PrintToString(v);
      }
    }
    front.leave();
  }
}

/// Grows a positive region from one vertex, until all vertices are closed.
TEST(VertexFront, reachesAllOpenVertices) {
  auto signs = signsOf([](const auto& v) { return v == Coordinates<2>{19, 12}; });
  VertexFront<2> front;
  front.begin(signs, nullptr, nullptr);
  front.queueAll();
  int entered = 0;
  while (const auto brickIndex = front.next()) {
    ASSERT_LT(++entered, 1000);
    front.enter(*brickIndex);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t r = 0; r < kBrickSide; ++r) {
        for (uint32_t beside = front.beside(*brickIndex, r); beside != 0; beside &= beside - 1) {
          front.close(*brickIndex, r, std::countr_zero(beside), true);
          changed = true;
        }
      }
    }
    front.leave();
  }
  front.end();
  forVertices(kLattice, [&](const Coordinates<2>& v) { EXPECT_TRUE(signs.at(v)); });
}

TEST(VertexFront, sharesUniformBricksAtTheEnd) {
  auto signs = signsOf([](const auto& v) { return v == Coordinates<2>{1, 1}; });
  VertexFront<2> front;
  front.begin(signs, nullptr, nullptr);
  front.close(0, 1, 1, false);
  EXPECT_FALSE(signs.at({1, 1}));
  EXPECT_NE(signs.slot(0), Signs<2>::kNegative);
  front.end();
  EXPECT_EQ(signs.slot(0), Signs<2>::kNegative);
}

}  // namespace
}  // namespace isostar
