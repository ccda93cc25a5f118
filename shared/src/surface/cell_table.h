// How a cell of the grid is cut, by the signs of its corners: for marching cubes and for the RBMT's
// tetrahedra.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "isostar/isostar.h"

namespace isostar {

/// An edge of a cell: from `corner` (bit a: the far plane on axis a) along all axes of the set
/// `axes`. One along several axes is a diagonal of a face or of the cell; it joins the corners of
/// that face that differ on all of `axes`, and belongs to the least corner of the face. Which of a
/// face's two diagonals is an edge of the RBMT follows from parity.
struct CellEdge {
  uint8_t corner = 0;
  uint8_t axes = 0;
  friend bool operator==(const CellEdge&, const CellEdge&) = default;
};

/// What the surface is inside a cell: the edges it crosses, and triangles over those.
struct CellCase {
  static constexpr std::size_t kMostEdges = 19, kMostTriangles = 12;
  uint8_t edgeCount = 0, triangleCount = 0;
  std::array<CellEdge, kMostEdges> edges{};
  std::array<std::array<uint8_t, 3>, kMostTriangles>
      triangles{};  // counter-clockwise seen from the negative side

  void add(const std::array<uint8_t, 3>& triangle) { triangles[triangleCount++] = triangle; }
  /// The edge's number in the case; it is added if it is new.
  uint8_t number(CellEdge e) {
    uint8_t n = 0;
    while (n < edgeCount && !(edges[n] == e)) ++n;
    if (n == edgeCount) edges[edgeCount++] = e;
    return n;
  }
};

/// The cases of one polygonizer, by the signs of the corners (bit c: corner c is positive).
/// `cubes`: one table. Faces with two crossings on each diagonal separate the positive corners, in
/// both cells alike, so that the surface is closed; polygons are cut so that no diagonal lies in a
/// face. `tetrahedra` (§3): one table for each parity of the cell, since neighbours mirror each
/// other.
using CellTable = std::array<CellCase, 256>;

[[nodiscard]] const CellTable& cellTable(Polygonizer polygonizer, unsigned parity);

}  // namespace isostar
