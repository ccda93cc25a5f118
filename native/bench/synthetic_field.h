#pragma once

#include <string>
#include <vector>

#include "volume/loaded_volume.h"

namespace isostar::bench {

struct SyntheticField {
  native::LoadedVolume volume;
  double isovalue = 0;
};

/// "sphere", "torus", "gyroid" or "noise", reproducible on every machine. Throws a Failure on
/// another name.
SyntheticField syntheticField(const std::string& name);

}  // namespace isostar::bench
