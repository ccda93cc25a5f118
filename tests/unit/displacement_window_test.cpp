#include "scalars/displacement_window.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isostar {
namespace {

TEST(DisplacementWindow, agreesWithTheInterpolationOfOneVertex) {
  const Lattice<3> lattice({23, 23, 23}, 1);
  const BrickTable<3> table(lattice);
  Displacements<3> displacements(table.total());
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
    auto& brick = displacements.writable(brickIndex);
    for (std::size_t block = 0; block < brick.size(); ++block) {
      brick[block] =
          (brickIndex + block) % 5 == 0
              ? Displacements<3>::kNone
              : static_cast<int8_t>(static_cast<int>(brickIndex * 64 + block) * 37 % 255 - 127);
    }
  }
  DisplacementWindow<3> window;
  for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
    window.load(displacements, table, table.brick(brickIndex));
    window.spread();
    for (std::size_t r = 0; r < 64; ++r) {
      for (int x = 0; x < 8; ++x) {
        const int32_t expected =
            window.smooth({x, static_cast<int32_t>(r % 8), static_cast<int32_t>(r / 8)});
        ASSERT_NEAR(window.at(r, x), expected, 2 + std::abs(expected) / 256);
      }
    }
  }
}

/// The largest sums: weights of 4^D in total, of displacements of ±127.
template <int D>
void expectLargestHeld() {
  Coordinates<D> box;
  box.fill(23);
  const BrickTable<D> table{Lattice<D>(box, 1)};
  for (const int far : {127, -127}) {
    Displacements<D> displacements(table.total());
    for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex)
      displacements.writable(brickIndex).fill(static_cast<int8_t>(far));
    Coordinates<D> middle;
    middle.fill(1);
    DisplacementWindow<D> window;
    window.load(displacements, table, middle);
    window.spread();
    const int expected = far * Displacements<D>::kPlaneSlope / Displacements<D>::kPerStep;
    for (std::size_t r = 0; r < power(kBrickSide, D - 1); ++r) {
      for (int x = 0; x < kBrickSide; ++x)
        ASSERT_NEAR(window.at(r, x), expected, 2 + std::abs(expected) / 128);
    }
  }
}

TEST(DisplacementWindow, holdsTheLargestDisplacements) {
  expectLargestHeld<2>();
  expectLargestHeld<3>();
  expectLargestHeld<4>();
}

}  // namespace
}  // namespace isostar
