#pragma once

#include <nlohmann/json.hpp>

#include "bench/subject.h"

namespace isostar::bench {

/// Bytes of two isosurfaces, each alone and both in one stream (§5.4).
nlohmann::ordered_json further(const Subject&, double other);

}  // namespace isostar::bench
