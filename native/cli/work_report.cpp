#include "cli/work_report.h"

#include <sys/resource.h>

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

namespace isostar::native {

uint64_t peakMemory() {
  // What getrusage() reports includes the process that started this one.
  std::ifstream status("/proc/self/status");
  for (std::string field; status >> field;) {
    uint64_t kilobytes = 0;
    if (field == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

void print(const WorkReport& report) {
  const nlohmann::ordered_json json = {
      {"vertices", report.vertices},
      {"triangles", report.triangles},
      {"bytes", report.bytes},
      {"milliseconds",
       {{report.work, report.codec}, {"polygonize", report.polygonize}, {"io", report.io}}},
      {"peakMemory", report.peakMemory}};
  std::cout << json.dump() << "\n";
}

}  // namespace isostar::native
