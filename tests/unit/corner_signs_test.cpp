#include "surface/corner_signs.h"

#include <gtest/gtest.h>

#include "grid/simplex.h"
#include "sign_fields.h"

namespace isostar {
namespace {

Coordinates<3> cornerOf(const Coordinates<3>& v, unsigned corner) {
  Coordinates<3> w = v;
  for (unsigned a = 0; a < 3; ++a) w[a] += static_cast<int32_t>(corner >> a & 1);
  return w;
}

/// Is an edge from `v` along a set of axes crossed? Its ends are even on all these axes and odd on
/// all.
bool crossed(const DenseSigns<3>& signs, const Coordinates<3>& v, unsigned axes) {
  unsigned odd = 0;
  for (unsigned a = 0; a < 3; ++a) {
    if ((axes >> a & 1) != 0 && (v[a] & 1) != 0) odd |= 1u << a;
  }
  return signs.at(cornerOf(v, odd)) != signs.at(cornerOf(v, axes ^ odd));
}

void expectCorners(const Coordinates<3>& box) {
  const Lattice<3> lattice(box, 1);
  for (const auto& field : signFields<3>(box)) {
    SCOPED_TRACE(field.name + " in " + testing::PrintToString(box));
    const DenseSigns<3> dense(lattice, field.positive);
    const auto signs = dense.bricks();
    for (std::size_t brickIndex = 0; brickIndex < signs.table().total(); ++brickIndex) {
      const CornerSigns corners(signs, brickIndex);
      const auto brick = signs.table().brick(brickIndex);
      for (unsigned axes = 1; axes < 8; ++axes) {
        const BrickWords inside = insideOf(lattice, brick, axes);
        for (std::size_t number = 0; number < power(kBrickSide, 3); ++number) {
          const auto v = vertexOf<3>(brick, number);
          const auto end = cornerOf(v, axes);
          const auto z = static_cast<unsigned>(number / 64),
                     at = static_cast<unsigned>(number % 64);
          const bool isInside = v[0] <= box[0] && v[1] <= box[1] && v[2] <= box[2] &&
                                end[0] <= box[0] && end[1] <= box[1] && end[2] <= box[2];
          ASSERT_EQ((inside[z] >> at & 1) != 0, isInside) << testing::PrintToString(v);
          if (!isInside) continue;
          ASSERT_EQ((corners.crossedEdges(axes, z) >> at & 1) != 0, crossed(dense, v, axes))
              << testing::PrintToString(v) << ", axes " << axes;
          if (axes != 7) continue;
          unsigned expected = 0;
          for (unsigned c = 0; c < 8; ++c) expected |= (dense.at(cornerOf(v, c)) ? 1u : 0u) << c;
          ASSERT_EQ(corners.around(z, at), expected) << testing::PrintToString(v);
          ASSERT_EQ((corners.crossedCells(z) >> at & 1) != 0, expected != 0 && expected != 255);
        }
      }
    }
  }
}

TEST(CornerSigns, areTheSignsOfCellsAndEdges) {
  expectCorners({1, 1, 1});
  expectCorners({8, 9, 7});
  expectCorners({17, 3, 16});
}

}  // namespace
}  // namespace isostar
