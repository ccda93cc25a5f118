#pragma once

#include <cstdint>
#include <string>

namespace isostar::bench {

/// The peak growth of this process in bytes while a decoder, "isostar" or "draco", decodes a file
/// to a mesh. Only the first call in a process is accurate: later calls reuse memory that earlier
/// ones freed.
uint64_t decoderMemory(const std::string& codec, const std::string& path);

}  // namespace isostar::bench
