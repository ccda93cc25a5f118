#pragma once

#include <nlohmann/json.hpp>

#include "bench/ruler.h"
#include "bench/subject.h"

namespace isostar::bench {

/// A layer as `isostar info --json` tells it.
nlohmann::ordered_json layerJson(const LayerInfo&);

/// Bytes and what they buy; distances are null where there is no surface yet.
nlohmann::ordered_json point(size_t bytes, const std::optional<measure::Distance>&);

/// As inspect() does, or the program's work ends with one line.
StreamInfo inspected(const std::vector<std::byte>& stream);

/// What a whole stream of isostar's shows, in grid steps.
Mesh decodedMesh(const std::vector<std::byte>& stream, const Subject&);

/// Points of a stream's prefixes: layer ends and the bytes just before, 2, 5 and 10 percent, and
/// `steps` of one factor from the first of these to the whole.
nlohmann::ordered_json prefixes(const std::vector<std::byte>& stream, const Subject&, const Ruler&,
                                int steps);

/// Points of whole streams of other bounds than the default one.
nlohmann::ordered_json otherBounds(const Subject&, const Ruler&);

}  // namespace isostar::bench
