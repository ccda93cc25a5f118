// What the encoder decides about an adaptive mesh (§4.3, §6): which cells stay whole, and the
// scalars of its vertices.
#pragma once

#include <vector>

#include "encoder/core/field.h"

namespace isostar {

/// Cells stay whole where the linear function on their simplices, from scalars chosen for it, keeps
/// the source's surface within the distance allowed. Scalars of coarse vertices are chosen anew:
/// the distance to the surface times the gradient where it is nearest, since a sample may be far
/// from linear between there and here.
template <int D>
class AdaptivePlan {
 public:
  using Point = std::array<double, D>;

  /// A vertex of the source's surface, on an axis edge of the finest grid.
  struct Crossing {
    Coordinates<D> from;  // the edge's lower end
    int axis;
    double at;        // 0 … 1 along the edge
    Point position;   // samples
    Point normal;     // unit, in steps along the smallest spacing
    double gradient;  // of the field, by such a step
  };

  AdaptivePlan(const GridField<D>& field, const Header& header, const Signs<D>& finest);

  [[nodiscard]] const std::vector<Crossing>& crossings() const { return crossings_; }
  [[nodiscard]] const Point& unit() const { return unit_; }
  [[nodiscard]] int finestLevel() const { return finestLevel_; }
  [[nodiscard]] Lattice<D> lattice(int level) const {
    return Lattice<D>(field_.last(), int32_t{1} << (finestLevel_ - level));
  }

  /// The scalar of a vertex of an octave, in the field's units; positive exactly where the field
  /// is.
  [[nodiscard]] double scalar(int level, const Coordinates<D>& v) const;

  /// Finds the cells that may stay whole for a distance in grid steps.
  void keep(double distance);
  /// On the lattice of `level`: the centres of the next coarser octave's cells that stay whole.
  [[nodiscard]] Signs<D> centres(int level) const;
  /// Has the largest whole cells around a point (in samples), as far as `reach` of their size,
  /// split. False where there are none. A whole cell's absent vertices reach half a cell into its
  /// neighbours, and by those further.
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
  void findCrossings(const Signs<D>& finest);
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
  Point unit_;  // of an edge along an axis, in steps along the smallest spacing
  std::vector<Crossing> crossings_;
  std::vector<std::vector<uint32_t>> nearest_;  // by octave and vertex: a crossing
  std::vector<std::vector<uint8_t>> cells_;     // by octave and cell's lower vertex
  std::vector<std::vector<uint8_t>> forbidden_;
};

}  // namespace isostar
