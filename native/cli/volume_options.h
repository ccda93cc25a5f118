#pragma once

#include <CLI/CLI.hpp>

#include "volume/volume_reader.h"

namespace isostar::native {

/// Options that say what to read of a file and how: those of raw volumes, --spacing, and the
/// choices where a file holds several volumes.
void addVolume(CLI::App&, VolumeRequest&);

}  // namespace isostar::native
