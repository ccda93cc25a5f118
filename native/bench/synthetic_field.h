#pragma once

#include <string>
#include <vector>

#include "volume/loaded_volume.h"

namespace isostar::bench {

struct SyntheticField {
  native::LoadedVolume volume;
  double isovalue = 0;
};

/// "sphere", "torus", "gyroid" or "noise"; the same on every machine. Fails with one line on
/// another name.
SyntheticField syntheticField(const std::string& name);

}  // namespace isostar::bench
