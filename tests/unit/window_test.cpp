#include "grid/window.h"

#include <gtest/gtest.h>

#include "sign_fields.h"

namespace isostar {
namespace {

/// Compares each vertex of a brick's window that lies within the halo of one of the brick's own
/// vertices.
template <int D>
void expectWindow(const DenseSigns<D>& dense, const Window<D>& window,
                  const Coordinates<D>& brick) {
  const auto& lattice = dense.lattice();
  constexpr int kHalo = Window<D>::kHalo;
  Coordinates<D> d;
  d.fill(-kHalo);
  for (std::size_t n = 0; n < power(Window<D>::kSide, D); ++n) {
    Coordinates<D> v;
    bool inHalo = true;
    for (int a = 0; a < D; ++a) {
      v[a] = brick[a] * kBrickSide + d[a];
      inHalo = inHalo && v[a] <= lattice.last[a] + kHalo;
    }
    if (inHalo) {
      const bool found =
          (window.rows[static_cast<std::size_t>(Window<D>::row(d))] >> (d[0] + kHalo) & 1) != 0;
      ASSERT_EQ(found, dense.mirroredAt(v))
          << testing::PrintToString(v) << " in brick " << testing::PrintToString(brick);
    }
    for (int a = 0; a < D && ++d[a] == kBrickSide + kHalo; ++a) d[a] = -kHalo;
  }
}

template <int D>
void expectWindows(const Coordinates<D>& box) {
  SCOPED_TRACE(testing::PrintToString(box));
  for (const auto& field : signFields<D>(box)) {
    const DenseSigns<D> dense(Lattice<D>(box, 1), field.positive);
    const auto signs = dense.bricks();
    Window<D> window;
    for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
      window.load(signs, signs.table().brick(brickIndex));
      expectWindow<D>(dense, window, signs.table().brick(brickIndex));
    }
  }
}

TEST(Window, holdsTheSurroundingsInBoxesOfEachWidth) {
  for (int32_t last = 0; last < 36; ++last) {
    expectWindows<2>({last, 5});
    expectWindows<2>({5, last});
  }
}

TEST(Window, holdsTheSurroundingsInsideAndAtAllBorders) {
  expectWindows<3>({25, 24, 23});
  expectWindows<3>({8, 9, 10});
  expectWindows<3>({15, 16, 7});
  expectWindows<3>({1, 2, 3});
  expectWindows<3>({0, 17, 1});
  expectWindows<3>({17, 0, 0});
  expectWindows<3>({0, 0, 0});
}

TEST(Window, holdsTheSurroundingsInFourDimensions) {
  expectWindows<4>({9, 3, 8, 1});
}

TEST(Window, rowsLieAtFixedDistances) {
  EXPECT_EQ(Window<3>::row({0, 1, 0}) - Window<3>::row({0, 0, 0}), Window<3>::rowStride(1));
  EXPECT_EQ(Window<3>::row({0, 0, 1}) - Window<3>::row({0, 0, 0}), Window<3>::rowStride(2));
  EXPECT_EQ(Window<3>::row({0, -2, -2}), 0);
  EXPECT_EQ(Window<3>::row({0, 9, 9}), Window<3>::kRows - 1);
}

}  // namespace
}  // namespace isostar
