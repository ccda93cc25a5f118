#include "scalars/displacements.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

TEST(Displacements, moveFromZeroAndStayInTheirRange) {
  int8_t value = Displacements<3>::kNone;
  Displacements<3>::move(value, 0);
  EXPECT_EQ(value, 0) << "a coded displacement of zero is known";
  Displacements<3>::move(value, 40);
  Displacements<3>::move(value, -50);
  EXPECT_EQ(value, -10);
  for (int i = 0; i < 10; ++i) Displacements<3>::move(value, -63);
  EXPECT_EQ(value, -127) << "kNone is not reached";
  for (int i = 0; i < 10; ++i) Displacements<3>::move(value, 63);
  EXPECT_EQ(value, 127);
}

TEST(Displacements, areUnknownAtFirst) {
  const Displacements<2> displacements(4);
  for (const int8_t value : displacements.at(2)) EXPECT_EQ(value, Displacements<2>::kNone);
}

template <int D>
void expectBlocksOfTwo() {
  for (std::size_t number = 0; number < power(kBrickSide, D); ++number) {
    const auto v = vertexOf<D>(Coordinates<D>{}, number);
    Coordinates<D> half;
    for (int a = 0; a < D; ++a) half[a] = v[a] / 2;
    EXPECT_EQ(Displacements<D>::block(number / kBrickSide, v[0]), Displacements<D>::blockAt(half));
    EXPECT_LT(Displacements<D>::blockAt(half), Displacements<D>::kBlocks);
  }
}

TEST(Displacements, blocksHaveTwoVerticesOnASide) {
  expectBlocksOfTwo<2>();
  expectBlocksOfTwo<3>();
  expectBlocksOfTwo<4>();
}

}  // namespace
}  // namespace isostar
