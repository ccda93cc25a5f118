#pragma once

#include <nlohmann/json.hpp>

#include "bench/sizes.h"

namespace isostar::bench {

/// The size of an adaptive stream with this bound in grid steps (§4.3, §5.1) and its two-sided
/// distance, measured at every vertex, with rate-distortion points of uniform streams, Draco and
/// simplified meshes. Of an empty surface only the size.
nlohmann::ordered_json adaptiveRate(const Subject&, double maxError, const SizeOptions&);

}  // namespace isostar::bench
