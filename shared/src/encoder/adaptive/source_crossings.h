// The vertices of the source's surface on the finest grid, with normals and gradients.
#pragma once

#include <vector>

#include "encoder/core/field.h"

namespace isostar {

/// A vertex of the source's surface, on an axis edge of the finest grid.
template <int D>
struct SourceCrossing {
  using Point = std::array<double, D>;

  Coordinates<D> from;  // the edge's lower end
  int axis;
  double at;        // 0 … 1 along the edge
  Point position;   // in samples
  Point normal;     // unit vector, in grid steps along the smallest spacing
  double gradient;  // size of the field's gradient, per such step
};

/// All of them, brick by brick. `unit`: the length of an edge by axis, in grid steps along the
/// smallest spacing; `finest`: the field's signs.
template <int D>
[[nodiscard]] std::vector<SourceCrossing<D>> findCrossings(
    const GridField<D>& field, const typename SourceCrossing<D>::Point& unit,
    const Signs<D>& finest);

}  // namespace isostar
