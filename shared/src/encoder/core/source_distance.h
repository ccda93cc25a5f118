// The distance between the surface coded so far and the source's: layers' heads state it, and the
// bound is checked with it.
#pragma once

#include "encoder/core/coded_crossing.h"
#include "encoder/core/field.h"
#include "estimate/hints.h"
#include "scalars/crossings.h"
#include "scalars/scalars.h"

namespace isostar {

/// Distances are in grid steps along the smallest spacing. They are measured at a sample of the
/// source's vertices.
template <int D>
class SourceDistance {
 public:
  /// `signs`: of the finest level; `active`: as of activeBricks(signs).
  SourceDistance(const GridField<D>& field, const Header& header, const Signs<D>& signs,
                 const std::vector<uint8_t>& active);

  /// RMS distance from the source's surface to what Polygonizer::Cubes makes of a coarse level's
  /// signs. Missing parts count. If there is no surface yet, it is the diagonal of the box.
  [[nodiscard]] double rms(const Signs<D>& coarse, const Hints<D>& hints) const;
  /// RMS distance to the finest level's surface. Scalars count 2^-finer half quantization steps; an
  /// empty table means that none are coded.
  [[nodiscard]] double rms(const Signs<D>& finest, const Scalars<D>& scalars,
                           const Hints<D>& hints = {}, int finer = 0) const;
  /// Marks, by brick index, the bricks that rms() reads.
  [[nodiscard]] const std::vector<uint8_t>& bricks() const { return bricks_; }

  /// Marks, by brick index, the bricks with an end of an edge on which a vertex of the finest
  /// surface is off by more than the bound. Empty if there are none. All scalars must be known.
  [[nodiscard]] std::vector<uint8_t> beyond(double bound, const Signs<D>& signs,
                                            const Scalars<D>& scalars,
                                            const std::vector<uint8_t>& active) const;
  /// The largest distance of a vertex of the finest surface from the source's on the same edge.
  /// Both surfaces have the same polygons over these vertices, so that no point of either is
  /// farther from the other.
  [[nodiscard]] double largest(const Signs<D>& signs, const Scalars<D>& scalars,
                               const std::vector<uint8_t>& active) const;

 private:
  using Point = std::array<double, D>;

  /// A vertex of the source's surface.
  struct Sample {
    std::size_t brickIndex;  // of its edge's first vertex
    int evenAt, oddAt;       // the edge's ends in a ScalarWindow
    double crossing;         // where on the edge it lies, from the even end (0) to the odd end (1)
    double perEdge;          // how far the surface moves when the vertex moves along the whole edge
    Point position, normal;
  };

  /// Calls visit(ends, coded crossing) for each crossing edge of the active bricks.
  template <class Visit>
  void forEachCrossing(const Signs<D>& signs, const Scalars<D>& scalars,
                       const std::vector<uint8_t>& active, Visit visit) const;
  [[nodiscard]] double size(int32_t value, double unit = 1) const;
  [[nodiscard]] double decoded(const ScalarWindow<D>& scalars, const Sample& sample,
                               double unit) const;
  [[nodiscard]] Point normal(const EdgeEnds<D>& ends) const;

  const GridField<D>& field_;
  const Header& header_;
  Point unit_;                   // the distance between samples, by axis
  std::vector<Sample> samples_;  // in order of brick indices
  std::vector<uint8_t> bricks_;  // by brick index: whether it has an end of a sample's edge
};

/// Calls enter(brickIndex) for each active brick, then visit(ends, length) for each of its crossing
/// edges on which a stream's polygonizer has vertices; `length` in grid steps.
template <int D, class Enter, class Visit>
void forEachCrossingEdge(const Header& header, const Signs<D>& signs,
                         const std::vector<uint8_t>& active, Enter enter, Visit visit);

/// The length of an edge along a set of axes, in grid steps along the smallest spacing. On the
/// fourth axis, time, a frame counts as one step.
[[nodiscard]] double edgeLength(const Placement& placement, unsigned axes);

template <int D, class Enter, class Visit>
void forEachCrossingEdge(const Header& header, const Signs<D>& signs,
                         const std::vector<uint8_t>& active, Enter enter, Visit visit) {
  std::array<double, 1u << D> lengths{};
  for (unsigned axes = 1; axes < lengths.size(); ++axes)
    lengths[axes] = edgeLength(header.placement, axes);
  forCrossedRows(
      signs, active, header.polygonizer == Polygonizer::Tetrahedra, enter,
      [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
        for (; crossed != 0; crossed &= crossed - 1)
          visit(EdgeEnds<D>(brick, r, static_cast<unsigned>(std::countr_zero(crossed)), axes),
                lengths[axes]);
      });
}

}  // namespace isostar
