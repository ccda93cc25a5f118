// The input of the polygonizers: signs, scalars, and the placement of the grid.
#pragma once

#include "isostar/isostar.h"
#include "scalars/scalars.h"
#include "util/decodes_all.h"

namespace isostar {

/// References are not owned and must outlive the surface.
template <int D>
struct Surface {
  const Signs<D>& signs;
  const Scalars<D>& scalars;  // known at both ends of all crossing edges of the polygonizer
  /// What must be added to |values| of positive and negative vertices to be exact, in half
  /// quantization steps.
  double positiveOffset = 0, negativeOffset = 0;
  const Placement& placement;
  /// Twice the distance to the domain's boundary, positive inside, in any unit, at all ends of
  /// crossing axis edges; null if the domain is the box.
  const Scalars<D>* domain = nullptr;

  /// Does it end inside the box?
  [[nodiscard]] bool isTrimmed() const { return kDecodesAll && domain != nullptr; }
  /// |scalar| in half quantization steps, from a value as Scalars store it.
  [[nodiscard]] double size(int32_t value) const {
    return value >= 0 ? value + positiveOffset : -double(value) + negativeOffset;
  }
};

}  // namespace isostar
