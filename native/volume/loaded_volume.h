#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::native {

/// A volume that owns its samples, with what its reader found worth saying; or an image, or a
/// sequence of volumes.
struct LoadedVolume {
  int dimension = 3;
  std::vector<float> samples;
  std::array<int32_t, 3> size{};
  int32_t frames = 1;
  Placement placement;
  std::vector<float> domain;  // see Volume; empty where it is the box
  std::vector<std::string> remarks;

  Volume view() const { return {samples, size, placement, domain}; }
  Image image() const {
    const auto& [origin, spacing, direction] = placement;
    return {samples, {size[0], size[1]}, {origin[0], origin[1]}, {spacing[0], spacing[1]}};
  }
  Sequence sequence() const { return {samples, size, frames, placement}; }
};

}  // namespace isostar::native
