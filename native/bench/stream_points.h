#pragma once

#include <nlohmann/json.hpp>

#include "bench/distance_meter.h"
#include "bench/subject.h"

namespace isostar::bench {

/// A layer as in `isostar info --json`.
nlohmann::ordered_json layerJson(const LayerInfo&);

/// A point of a rate-distortion curve; the distances are null if there is no surface yet.
nlohmann::ordered_json point(size_t bytes, const std::optional<measure::Distance>&);

/// inspect(), which must succeed.
StreamInfo inspected(const std::vector<std::byte>& stream);

/// The surface of a complete stream, in grid steps.
Mesh decodedMesh(const std::vector<std::byte>& stream, const Subject&);

/// Points of a stream's prefixes: at each layer's end and one byte before, at 2, 5 and 10 percent,
/// and `steps` sizes in geometric progression from 2 percent to the whole stream.
nlohmann::ordered_json prefixes(const std::vector<std::byte>& stream, const Subject&,
                                const DistanceMeter&, int steps);

/// Points of complete streams with other bounds than the default one.
nlohmann::ordered_json otherBounds(const Subject&, const DistanceMeter&);

}  // namespace isostar::bench
