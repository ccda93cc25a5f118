#pragma once

#include <cstdint>
#include <string>

namespace isostar::bench {

/// By how many bytes this process grows at most while one decoder, "isostar" or "draco", makes a
/// mesh of a file. Only the first call in a process tells the truth: later ones find room that
/// earlier ones have left.
uint64_t decoderMemory(const std::string& codec, const std::string& path);

}  // namespace isostar::bench
