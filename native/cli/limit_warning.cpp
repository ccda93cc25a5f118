#include "cli/limit_warning.h"

#include "files/text.h"

namespace isostar::native {
namespace {

/// "134 M".
std::string counted(uint64_t count) {
  const double value = static_cast<double>(count);
  return value < 1e6 ? text("%.0f", value) : text("%.0f M", value / 1e6);
}

std::string describe(uint64_t count, uint64_t most, const char* what) {
  return text("%s %s are over a decoder's own default limit of %s", counted(count).c_str(), what,
              counted(most).c_str());
}

}  // namespace

std::string overLimits(const StreamInfo& info, const Limits& limits) {
  uint64_t samples = static_cast<uint64_t>(info.frames);
  for (const int32_t side : info.size) samples *= static_cast<uint64_t>(side);
  if (info.vertices > limits.vertices) return describe(info.vertices, limits.vertices, "vertices");
  if (samples > limits.samples) return describe(samples, limits.samples, "samples");
  return {};
}

}  // namespace isostar::native
