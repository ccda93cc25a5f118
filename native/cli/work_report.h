#pragma once

#include <cstdint>
#include <string>

namespace isostar::native {

/// The peak memory of this process so far, in bytes.
uint64_t peakMemory();

/// The output of `encode --json` and `decode --json`.
struct WorkReport {
  const char* work = "";  // "encode" or "decode"
  uint64_t vertices = 0, triangles = 0, bytes = 0, peakMemory = 0;
  double codec = 0, polygonize = 0, io = 0;  // milliseconds
};
void print(const WorkReport&);

}  // namespace isostar::native
