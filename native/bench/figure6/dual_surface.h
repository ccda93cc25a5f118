#pragma once

#include <array>
#include <functional>
#include <vector>

#include "grid/lattice.h"
#include "isostar/isostar.h"

namespace isostar::bench {

/// A surface with a vertex in each crossing cell and a quadrilateral for each crossing edge (dual
/// contouring), made from signs only: vertices are relaxed within their cells (S. Gibson,
/// Constrained elastic surface nets, 1998).
///
/// Cells of zero width on the sides of the box contain the vertices there, so that the surface
/// reaches the sides.
class DualSurface {
 public:
  using Point = std::array<double, 3>;
  using Positive = std::function<bool(const Coordinates<3>&)>;

  /// `positive` is called with vertices of the lattice; `unit` is the length of a grid step along
  /// each axis.
  DualSurface(const Lattice<3>& lattice, const Point& unit, const Positive& positive);

  [[nodiscard]] size_t vertices() const { return positions_.size(); }
  /// In grid steps times `unit`.
  [[nodiscard]] const Point& position(size_t vertex) const { return positions_[vertex]; }
  /// The unit normal of the relaxed surface.
  [[nodiscard]] const Point& normal(size_t vertex) const { return normals_[vertex]; }
  /// Calls visit(vertex) for all vertices that share an edge with a vertex, possibly twice.
  template <class Visit>
  void forEachNeighbour(size_t vertex, Visit visit) const {
    for (uint32_t i = firstNeighbour_[vertex]; i < firstNeighbour_[vertex + 1]; ++i)
      visit(neighbours_[i]);
  }

  /// The surface with each vertex displaced along its normal, but not off a side of the box. An
  /// empty vector: without displacements.
  [[nodiscard]] Mesh mesh(const std::vector<double>& displacements) const;

 private:
  struct Box {
    Point low, high;
  };
  void link();
  void relax(int rounds);
  void findNormals();

  std::vector<std::array<uint32_t, 4>> quads_;
  std::vector<Point> positions_, normals_;
  std::vector<Box> cells_;  // the cell of each vertex
  std::vector<uint32_t> firstNeighbour_, neighbours_;
};

}  // namespace isostar::bench
