#pragma once

#include <nlohmann/json.hpp>

#include "bench/subject.h"

namespace isostar::bench {

/// The bytes of two isosurfaces, each in its own stream and both in one (§5.4).
nlohmann::ordered_json furtherIsovalue(const Subject&, double other);

}  // namespace isostar::bench
