#pragma once

#include <nlohmann/json.hpp>

#include "bench/subject.h"

namespace isostar::bench {

/// Components and genus of what each layer of a stream of one topology shows (§4.3), and its bytes
/// beside a uniform stream's. A genus is null where a mesh is no oriented manifold.
nlohmann::ordered_json layerTopology(const Subject&);

}  // namespace isostar::bench
