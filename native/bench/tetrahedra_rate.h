#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/sizes.h"

namespace isostar::bench {

struct TetrahedraRequest {
  std::string path;    // the tetrahedra
  std::string stream;  // their stream, by `isostar encode`
  double isovalue = 0;
};

/// The distance of a stream's surface to the isosurface of the tetrahedra (§1), in both directions
/// and from every vertex, with rate-distortion points of Draco and of simplified meshes of that
/// isosurface. All in grid steps of the stream. Throws a Failure if either has no surface.
nlohmann::ordered_json tetrahedraRate(const TetrahedraRequest&, const SizeOptions&);

}  // namespace isostar::bench
