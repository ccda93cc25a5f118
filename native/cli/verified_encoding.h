#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "isostar/isostar.h"
#include "volume/loaded_volume.h"

namespace isostar::native {

/// Encodes with a progress bar. The bound holds when this returns: encode() measures uniform
/// streams itself; adaptive ones are decoded here and compared with the source's surface both ways,
/// and encoded again until they keep it. Throws Failure if the bound cannot be held.
std::vector<std::byte> encodeVerified(const LoadedVolume& volume, EncodeOptions options,
                                      const std::string& path);

}  // namespace isostar::native
