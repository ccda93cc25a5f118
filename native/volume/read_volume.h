#pragma once

#include <array>
#include <optional>
#include <string>

#include "volume/loaded_volume.h"
#include "volume/sample_buffer.h"

namespace isostar::native {

/// What the command line says about a volume. Size and type are for raw files, which tell nothing
/// themselves.
struct VolumeRequest {
  std::string path;
  std::optional<ClaimedSize> size{};
  std::optional<SampleType> type{};
  std::optional<std::array<double, 3>> spacing{};  // overrules the file's
};

/// A volume of any known format, told by its extension. The world is the one of NRRD and ITK: LPS,
/// millimetres. Fails with one line.
LoadedVolume readVolume(const VolumeRequest&);

}  // namespace isostar::native
