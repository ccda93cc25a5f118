#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/subject.h"

namespace isostar::bench {

struct TimeOptions {
  double milliseconds = 1500;  // how long each race lasts, more or less
  std::string keep;            // a folder for the two files that were decoded, or none
};

/// The shortest times of isostar and of Draco at 10 bits, in turns, in milliseconds.
nlohmann::ordered_json times(const Subject&, const TimeOptions&);

}  // namespace isostar::bench
