#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace isostar::native {

/// Milliseconds since its making.
class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
        .count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The most memory this process has had so far, in bytes.
uint64_t peakMemory();

/// What `encode --json` and `decode --json` print.
struct WorkReport {
  const char* work = "";  // "encode" or "decode"
  uint64_t vertices = 0, triangles = 0, bytes = 0, peakMemory = 0;
  double codec = 0, polygonize = 0, io = 0;  // milliseconds
};
void print(const WorkReport&);

}  // namespace isostar::native
