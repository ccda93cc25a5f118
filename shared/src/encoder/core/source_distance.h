// The distance between the surface coded so far and the source's, which layers' heads state.
#pragma once

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

  [[nodiscard]] double decoded(const ScalarWindow<D>& scalars, const Sample& sample,
                               double unit) const;
  [[nodiscard]] Point normal(const EdgeEnds<D>& ends) const;

  const GridField<D>& field_;
  const Header& header_;
  Point unit_;                   // the distance between samples, by axis
  std::vector<Sample> samples_;  // in order of brick indices
  std::vector<uint8_t> bricks_;  // by brick index: whether it has an end of a sample's edge
};

/// Calls enter(brickIndex) for each marked brick of a range, then visit(ends, length) for each of
/// its crossing edges on which a stream's polygonizer has vertices; `length` in grid steps.
template <int D, class Enter, class Visit>
void forEachCrossingEdge(const Header& header, const Signs<D>& signs,
                         const std::vector<uint8_t>& marked, const BrickRange& range, Enter enter,
                         Visit visit);

/// The size of a coded scalar in half quantization steps. `unit`: that of the value.
[[nodiscard]] inline double sizeOf(int32_t value, const Header& header, double unit = 1) {
  return value >= 0 ? value * unit + 2 * header.positiveOffset - 1
                    : 2 * header.negativeOffset - 1 - value * unit;
}

/// The length of an edge along a set of axes, in grid steps along the smallest spacing. On the
/// fourth axis, time, a frame counts as one step.
[[nodiscard]] double edgeLength(const Placement& placement, unsigned axes);

template <int D, class Enter, class Visit>
void forEachCrossingEdge(const Header& header, const Signs<D>& signs,
                         const std::vector<uint8_t>& marked, const BrickRange& range, Enter enter,
                         Visit visit) {
  std::array<double, 1u << D> lengths{};
  for (unsigned axes = 1; axes < lengths.size(); ++axes)
    lengths[axes] = edgeLength(header.placement, axes);
  forCrossedRows(
      signs, marked, range, header.polygonizer == Polygonizer::Tetrahedra, enter,
      [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
        for (; crossed != 0; crossed &= crossed - 1)
          visit(EdgeEnds<D>(brick, r, static_cast<unsigned>(std::countr_zero(crossed)), axes),
                lengths[axes]);
      });
}

}  // namespace isostar
