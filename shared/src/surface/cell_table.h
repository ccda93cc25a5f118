// How the surface cuts a cell of the grid, by the signs of its corners: for marching cubes and for
// the RBMT's tetrahedra.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "isostar/isostar.h"

namespace isostar {

/// An edge of a cell: from `corner` (bit a: the far plane on axis a) along all axes of the set
/// `axes`. An edge along several axes is a diagonal of a face or of the cell: it joins corners of
/// that face that differ on all of `axes`, and is named by the face's least corner. Which of a
/// face's two diagonals is an edge of the RBMT follows from parity.
struct CellEdge {
  uint8_t corner = 0;
  uint8_t axes = 0;
  friend bool operator==(const CellEdge&, const CellEdge&) = default;
};

/// The surface inside a cell: the edges that it crosses, and triangles between them.
struct CellCase {
  static constexpr std::size_t kMostEdges = 19, kMostTriangles = 12;
  uint8_t edgeCount = 0, triangleCount = 0;
  std::array<CellEdge, kMostEdges> edges{};
  /// Indices into `edges`, counter-clockwise seen from the negative side.
  std::array<std::array<uint8_t, 3>, kMostTriangles> triangles{};

  /// Appends a triangle of indices into `edges`.
  void add(const std::array<uint8_t, 3>& triangle) { triangles[triangleCount++] = triangle; }
  /// The edge's index in `edges`; it is added if it is not there.
  uint8_t number(CellEdge e) {
    uint8_t n = 0;
    while (n < edgeCount && !(edges[n] == e)) ++n;
    if (n == edgeCount) edges[edgeCount++] = e;
    return n;
  }
};

/// The cases of one polygonizer, by the signs of the corners (bit c: corner c is positive).
/// Polygonizer::Cubes has one table: faces with two crossings on each diagonal separate the
/// positive corners, in both cells alike, so that the surface is closed; polygons are cut so that
/// no diagonal lies in a face. Polygonizer::Tetrahedra (§3) has one table for each parity of the
/// cell, because neighbours mirror each other.
using CellTable = std::array<CellCase, 256>;

/// `parity`: bit a is set if the cell's least corner is odd on axis a; Cubes ignores it. Tables are
/// made on the first call.
[[nodiscard]] const CellTable& cellTable(Polygonizer polygonizer, unsigned parity);

}  // namespace isostar
