// The distortion of a vertex that has one crossing edge.
#pragma once

#include "coding/exchange/crossing_distortion.h"

namespace isostar {

/// A vertex of `size` half quantization steps with one crossing edge. The far end's actual size is
/// 100, its coded one `coded`. A crossing may move by 1/10 of the edge.
inline CrossingDistortion<3> oneEdge(double size, double coded, double most = 1) {
  CrossingDistortion<3> distortion(0.0);
  distortion.add({size / (size + 100), 100, coded, 10, 1, most});
  return distortion;
}

}  // namespace isostar
