#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/subject.h"

namespace isostar::bench {

struct TimeOptions {
  double milliseconds = 1500;  // the approximate duration of each measurement
  std::string keep;            // a folder for the two decoded files; empty: they are not kept
  unsigned threads = 2;        // of the measurements with several threads
};

/// The shortest times of isostar, with one thread and with several, and of Draco at 10 bits, in
/// milliseconds.
nlohmann::ordered_json times(const Subject&, const TimeOptions&);

}  // namespace isostar::bench
