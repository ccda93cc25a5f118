// The encoder's plan of an adaptive mesh (§4.3, §6): which cells are kept, and the scalars of its
// vertices.
#pragma once

#include <vector>

#include "encoder/adaptive/source_crossings.h"

namespace isostar {

/// A cell is kept if the linear functions of its simplices keep the source's surface within the
/// allowed distance. Scalars of coarse vertices are not those of their samples, which may be far
/// from linear between there and the surface: they are the distance to the surface times the
/// gradient at its nearest point.
template <int D>
class AdaptivePlan {
 public:
  using Point = typename SourceCrossing<D>::Point;

  using Crossing = SourceCrossing<D>;

  AdaptivePlan(const GridField<D>& field, const Header& header, const Signs<D>& finest);

  [[nodiscard]] const std::vector<Crossing>& crossings() const { return crossings_; }
  [[nodiscard]] const Point& unit() const { return unit_; }
  [[nodiscard]] int finestLevel() const { return finestLevel_; }
  [[nodiscard]] Lattice<D> lattice(int level) const {
    return Lattice<D>(field_.last(), int32_t{1} << (finestLevel_ - level));
  }

  /// The scalar of a vertex of a level, in the field's units. Its sign is always the field's.
  [[nodiscard]] double scalar(int level, const Coordinates<D>& v) const;

  /// Finds the cells that may be kept for an allowed distance in grid steps.
  void findKeptCells(double allowed);
  /// The centres of those cells of the next coarser level that are kept, on the lattice of `level`.
  [[nodiscard]] Signs<D> centres(int level) const;
  /// Splits the largest kept cells around a point (in samples), within `reach` times their size,
  /// from the next call of findKeptCells() on. False if there are none. The absent vertices of a
  /// kept cell extend half a cell into its neighbours, and those that depend on them further.
  bool forbid(const Point& p, double reach);

 private:
  enum Cell : uint8_t { kEmpty, kWhole, kSplit };
  static constexpr uint32_t kNone = UINT32_MAX;
  static constexpr int32_t kMostStep = 32;

  [[nodiscard]] static std::size_t index(const Lattice<D>& lattice, const Coordinates<D>& v) {
    std::size_t at = 0;
    for (int a = D - 1; a >= 0; --a)
      at = at * static_cast<std::size_t>(lattice.last[a] + 1) + static_cast<std::size_t>(v[a]);
    return at;
  }
  void findNearest(int level);
  [[nodiscard]] double distance(int level, const Coordinates<D>& v) const;
  [[nodiscard]] bool splittable(int level, const Coordinates<D>& cell) const;
  [[nodiscard]] bool surfaceFits(int level, const Coordinates<D>& cell, const Point& p,
                                 double distance) const;
  [[nodiscard]] bool signsFit(int level, const Coordinates<D>& cell, double distance) const;
  [[nodiscard]] std::pair<double, double> linear(int level, const Coordinates<D>& cell,
                                                 const Point& p) const;

  const GridField<D>& field_;
  int finestLevel_;
  Point unit_;  // the length of an edge by axis, in grid steps along the smallest spacing
  std::vector<Crossing> crossings_;
  std::vector<std::vector<uint32_t>> nearest_;  // by level and vertex: the number of a crossing
  std::vector<std::vector<uint8_t>> cells_;     // by level and the cell's lower vertex
  std::vector<std::vector<uint8_t>> forbidden_;
};

}  // namespace isostar
