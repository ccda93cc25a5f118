#pragma once

#include <nlohmann/json.hpp>

#include "bench/sizes.h"

namespace isostar::bench {

/// An adaptive stream of this bound in grid steps (§4.3, §5.1), with its distance from every
/// vertex, both ways; and what uniform streams, Draco and simplified meshes cost at any distance.
/// Only the size where the surface is empty.
nlohmann::ordered_json adaptiveRate(const Subject&, double maxError, const SizeOptions&);

}  // namespace isostar::bench
