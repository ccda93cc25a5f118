// What is known of the surface's location beside the signs and before the scalars.
#pragma once

#include "estimate/shape_estimate.h"
#include "scalars/displacements.h"

namespace isostar {

/// Optional input of estimateMissing(). `displacements` is not owned.
template <int D>
struct Hints {
  /// The one that locates this level's surface best.
  SmoothingFilter filter = SmoothingFilter::Middle;
  const Displacements<D>* displacements = nullptr;  // null, or an empty table: none
  [[nodiscard]] bool displaced() const {
    return displacements != nullptr && displacements->tableSize() != 0;
  }
};

}  // namespace isostar
