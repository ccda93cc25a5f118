#pragma once

#include <nlohmann/json.hpp>

#include "bench/subject.h"

namespace isostar::bench {

/// The components and the genus of each layer's surface in a stream that preserves topology (§4.3),
/// and the bytes of this stream and of a uniform one. A genus is null if the mesh is not an
/// oriented manifold.
nlohmann::ordered_json layerTopology(const Subject&);

}  // namespace isostar::bench
