// What a surface is made of: signs, scalars, and where the grid stands.
#pragma once

#include "isostar/isostar.h"
#include "scalars/scalars.h"

namespace isostar {

template <int D>
struct Surface {
  const Signs<D>& signs;
  const Scalars<D>& scalars;  // of all ends of edges that the polygonizer crosses
  /// What to add to half quanta at positive and negative vertices to be exact.
  double positiveOffset = 0, negativeOffset = 0;
  const Placement& placement;
  /// Twice the distance to the domain's boundary, positive inside, in any unit, at all ends of axis
  /// edges that are crossed; null where the domain is the box.
  const Scalars<D>* domain = nullptr;

  /// |scalar - isovalue| in half quanta, from its value as Scalars keep it.
  [[nodiscard]] double size(int32_t value) const {
    return value >= 0 ? value + positiveOffset : -double(value) + negativeOffset;
  }
};

}  // namespace isostar
