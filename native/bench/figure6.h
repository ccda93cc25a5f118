#pragma once

#include <nlohmann/json.hpp>

#include "bench/subject.h"

namespace isostar::bench {

struct Figure6Options {
  size_t points = 10000;  // samples of each distance measurement
  int prefixes = 12;      // of the default stream, besides those that end with a layer
};

/// Rate and distortion as in the paper's figure 6: points { bytes, rms, max } of uniform, adaptive
/// and single-rate streams, and of an octree coder.
nlohmann::ordered_json figure6(const Subject&, const Figure6Options&);

}  // namespace isostar::bench
