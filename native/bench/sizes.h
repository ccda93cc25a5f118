#pragma once

#include <nlohmann/json.hpp>

#include "bench/subject.h"

namespace isostar::bench {

struct SizeOptions {
  size_t points = 10000;  // that tell a distance
  int prefixes = 12;      // besides those that end with a layer and at 2, 5 and 10 percent
  bool rate = false;      // also what takes long: simplified meshes, other codecs
};

/// Bytes and distances of everybody: exact, the same on every machine with the same libraries.
nlohmann::ordered_json sizes(const Subject&, const SizeOptions&);

}  // namespace isostar::bench
