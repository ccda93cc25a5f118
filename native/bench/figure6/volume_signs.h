#pragma once

#include "grid/signs.h"
#include "isostar/isostar.h"

namespace isostar::bench {

/// The samples' signs, as both comparison codecs tell them: positive above the isovalue.
Signs<3> signsOf(const Volume&, double isovalue);

/// How often a cell of four on the longest axis must be halved to be the grid's own: the octaves
/// that isostar has.
int finestLevelOf(const std::array<int32_t, 3>& size);

/// The last sample on each axis.
inline Coordinates<3> lastSample(const std::array<int32_t, 3>& size) {
  return {size[0] - 1, size[1] - 1, size[2] - 1};
}

}  // namespace isostar::bench
