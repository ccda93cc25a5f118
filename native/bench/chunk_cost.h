#pragma once

#include <nlohmann/json.hpp>

#include "bench/subject.h"

namespace isostar::bench {

/// The bytes of a stream as it is and in chunks of 128 and 64 cells a side: with models that
/// continue from chunk to chunk (what is left is the price of contexts cut at borders), that start
/// at their coarse state, and that start anew; and the sum of independent streams of cropped
/// volumes.
nlohmann::ordered_json chunkCost(const Subject&);

}  // namespace isostar::bench
