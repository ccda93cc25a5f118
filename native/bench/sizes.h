#pragma once

#include <nlohmann/json.hpp>

#include "bench/subject.h"

namespace isostar::bench {

struct SizeOptions {
  size_t points = 10000;  // samples of each distance measurement
  int prefixes = 12;      // besides those that end with a layer and at 2, 5 and 10 percent
  bool rate = false;      // also simplified meshes and other codecs, which take long
};

/// The bytes and distances of all codecs. They are reproducible on every machine with the same
/// libraries.
nlohmann::ordered_json sizes(const Subject&, const SizeOptions&);

}  // namespace isostar::bench
