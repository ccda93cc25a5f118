#pragma once

#include "grid/signs.h"
#include "isostar/isostar.h"

namespace isostar::bench {

/// The signs of the samples, which both comparison codecs encode: positive above the isovalue.
Signs<3> signsOf(const Volume&, double isovalue);

/// How often a base cell, of four along the longest axis, must be halved to become a cell of the
/// grid: the same number of refinement levels as in isostar.
int finestLevelOf(const std::array<int32_t, 3>& size);

/// The last sample on each axis.
inline Coordinates<3> lastSample(const std::array<int32_t, 3>& size) {
  return {size[0] - 1, size[1] - 1, size[2] - 1};
}

}  // namespace isostar::bench
