#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::native {

/// A volume, an image or a sequence of volumes that owns its samples.
struct LoadedVolume {
  int dimension = 3;
  std::vector<float> samples;
  std::array<int32_t, 3> size{};
  int32_t frames = 1;
  Placement placement;
  std::vector<float> domain;         // see Volume; empty if the domain is the box
  std::vector<std::string> remarks;  // warnings for the user
  std::string kind;                  // what was read, "NRRD"
  std::string type;                  // of the samples in the file, "16-bit integers"
  std::vector<std::string> parts;    // what else can be chosen, "--channel 1: DAPI"

  Volume view() const {
    return {.samples = samples, .size = size, .placement = placement, .domain = domain};
  }
  Image image() const {
    const auto& [origin, spacing, direction] = placement;
    return {.samples = samples,
            .size = {size[0], size[1]},
            .origin = {origin[0], origin[1]},
            .spacing = {spacing[0], spacing[1]}};
  }
  Sequence sequence() const {
    return {.samples = samples, .size = size, .frames = frames, .placement = placement};
  }
};

}  // namespace isostar::native
