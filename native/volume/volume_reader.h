#pragma once

#include <array>
#include <optional>
#include <string>

#include "volume/choices.h"
#include "volume/loaded_volume.h"
#include "volume/sample_buffer.h"

namespace isostar::native {

/// The command line's description of a volume. Size and type are for raw files, which have no
/// header.
struct VolumeRequest {
  std::string path;
  std::optional<ClaimedSize> size{};
  std::optional<SampleType> type{};
  std::optional<std::array<double, 3>> spacing{};  // overrides the file's
  Choices choices{};
};

/// Reads a volume of any known format, which the extension determines. World coordinates are those
/// of NRRD and ITK: LPS, in millimetres. Throws a Failure.
LoadedVolume readVolume(const VolumeRequest&);

}  // namespace isostar::native
