#pragma once

#include <array>
#include <functional>
#include <vector>

#include "grid/lattice.h"
#include "isostar/isostar.h"

namespace isostar::bench {

/// A surface with a vertex for each crossing cell and a quadrangle for each crossing edge (dual
/// contouring), made of signs alone: vertices are relaxed within their cells (S. Gibson,
/// Constrained elastic surface nets, 1998).
///
/// Cells of no width at the box's end hold the vertices that lie in the end, so that the surface
/// reaches it.
class DualSurface {
 public:
  using Point = std::array<double, 3>;
  using Positive = std::function<bool(const Coordinates<3>&)>;

  /// positive(vertex of the lattice); `unit` is the length of a sample step by axis.
  DualSurface(const Lattice<3>& lattice, const Point& unit, const Positive& positive);

  [[nodiscard]] size_t vertices() const { return positions_.size(); }
  /// In samples times unit.
  [[nodiscard]] const Point& position(size_t vertex) const { return positions_[vertex]; }
  /// Unit, of the relaxed surface.
  [[nodiscard]] const Point& normal(size_t vertex) const { return normals_[vertex]; }
  /// Calls visit(vertex) for those that share an edge with a vertex; some twice.
  template <class Visit>
  void forEachNeighbour(size_t vertex, Visit visit) const {
    for (uint32_t i = firstNeighbour_[vertex]; i < firstNeighbour_[vertex + 1]; ++i)
      visit(neighbours_[i]);
  }

  /// Each vertex moved along its normal, those in the box's end within it. No displacements: none.
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
  std::vector<Box> cells_;  // of each vertex
  std::vector<uint32_t> firstNeighbour_, neighbours_;
};

}  // namespace isostar::bench
