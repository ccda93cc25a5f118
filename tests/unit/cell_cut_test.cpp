#include "surface/cell_cut.h"

#include <gtest/gtest.h>

#include <set>

namespace isostar {
namespace {

TEST(EdgePositions, differForAllEdgesOfABrick) {
  std::set<unsigned> positions;
  for (unsigned axes = 1; axes < 8; ++axes) {
    for (unsigned z = 0; z < EdgePositions::kSide; ++z) {
      for (unsigned y = 0; y < EdgePositions::kSide; ++y) {
        for (unsigned x = 0; x < EdgePositions::kSide; ++x) {
          const unsigned at = EdgePositions::at(axes, x, y, z);
          EXPECT_LT(at, EdgePositions::kCount);
          EXPECT_TRUE(positions.insert(at).second);
        }
      }
    }
  }
  EXPECT_EQ(positions.size(), EdgePositions::kCount);
}

TEST(CellCut, hasTheEdgesOfTheCasesTriangles) {
  for (unsigned signs = 0; signs < 256; ++signs) {
    const CellCase& shape = cellTable(Polygonizer::Cubes, 0)[signs];
    const CellCut cut(shape, false);
    ASSERT_EQ(cut.corners, 3u * shape.triangleCount);
    for (std::size_t i = 0; i < cut.corners; ++i) {
      const CellEdge edge = shape.edges[shape.triangles[i / 3][i % 3]];
      EXPECT_EQ(cut.edges[i], EdgePositions::at(edge.axes, edge.corner & 1, edge.corner >> 1 & 1,
                                                edge.corner >> 2 & 1));
    }
  }
}

TEST(CellCut, reversesItsTrianglesWhenMirrored) {
  for (unsigned signs = 0; signs < 256; ++signs) {
    const CellCase& shape = cellTable(Polygonizer::Tetrahedra, 3)[signs];
    const CellCut cut(shape, false), mirrored(shape, true);
    ASSERT_EQ(mirrored.corners, cut.corners);
    for (std::size_t i = 0; i < cut.corners; i += 3) {
      EXPECT_EQ(mirrored.edges[i], cut.edges[i]);
      EXPECT_EQ(mirrored.edges[i + 1], cut.edges[i + 2]);
      EXPECT_EQ(mirrored.edges[i + 2], cut.edges[i + 1]);
    }
  }
}

}  // namespace
}  // namespace isostar
