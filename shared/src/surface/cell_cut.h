// A cell's triangles as positions in the array of vertices around the current brick.
#pragma once

#include "grid/signs.h"
#include "surface/cell_table.h"

namespace isostar {

/// Positions in an array of all vertices that a brick's cells may need, including the first ones of
/// the next bricks: one for each edge, by its set of axes and its least vertex, 0 … 8 on each axis.
struct EdgePositions {
  static constexpr unsigned kSide = kBrickSide + 1, kOfSet = kSide * kSide * kSide,
                            kCount = 7 * kOfSet;

  static constexpr unsigned at(unsigned axes, unsigned x, unsigned y, unsigned z) {
    return (axes - 1) * kOfSet + x + kSide * y + kSide * kSide * z;
  }
};

/// The corners of the triangles in a cell, three per triangle: positions of their edges relative to
/// that of the cell's edge along axis 0.
struct CellCut {
  std::size_t corners = 0;
  std::array<uint16_t, CellCase::kMostTriangles * 3> edges{};

  CellCut(const CellCase& shape, bool mirrored) : corners(std::size_t{shape.triangleCount} * 3) {
    for (std::size_t i = 0; i < corners; ++i) {
      const std::size_t corner = mirrored && i % 3 != 0 ? 3 - i % 3 : i % 3;
      const auto [first, axes] = shape.edges[shape.triangles[i / 3][corner]];
      edges[i] =
          static_cast<uint16_t>(EdgePositions::at(axes, first & 1, first >> 1 & 1, first >> 2 & 1));
    }
  }
};

}  // namespace isostar
