#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/sizes.h"

namespace isostar::bench {

struct TetrahedraRequest {
  std::string path;    // of the tetrahedra
  std::string stream;  // that `isostar encode` has made of them
  double isovalue = 0;
};

/// A stream's distance to the isosurface of the tetrahedra themselves (§1), both ways, from every
/// vertex, and what Draco and simplified meshes of that isosurface cost at any distance; in grid
/// steps of the stream. Fails with one line where either has no surface.
nlohmann::ordered_json tetrahedraRate(const TetrahedraRequest&, const SizeOptions&);

}  // namespace isostar::bench
