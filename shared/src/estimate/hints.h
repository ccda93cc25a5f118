// What has been told of where the surface lies, beside its signs and before its scalars.
#pragma once

#include "estimate/shape_estimate.h"
#include "scalars/displacements.h"

namespace isostar {

template <int D>
struct Hints {
  SmoothingFilter filter = SmoothingFilter::Middle;  // that places this octave's surface best
  const Displacements<D>* displacements = nullptr;   // null, or without places: none
  [[nodiscard]] bool displaced() const {
    return displacements != nullptr && displacements->tableSize() != 0;
  }
};

}  // namespace isostar
