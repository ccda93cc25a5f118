#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::native {

/// A volume that owns its samples, with what its reader found worth saying.
struct LoadedVolume {
  std::vector<float> samples;
  std::array<int32_t, 3> size{};
  Placement placement;
  std::vector<std::string> remarks;

  Volume view() const { return {samples, size, placement}; }
};

}  // namespace isostar::native
