#include "bench/decoder_memory.h"

#include <fstream>

#include "bench/draco_codec.h"
#include "bench/isostar_codec.h"
#include "files/failure.h"
#include "files/input_file.h"

namespace isostar::bench {
namespace {

/// A field of /proc/self/status, in bytes.
uint64_t status(const std::string& field) {
  std::ifstream lines("/proc/self/status");
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(field + ":")) return 1024 * std::stoull(line.substr(field.size() + 1));
  }
  throw native::Failure("/proc/self/status", "has no " + field);
}

}  // namespace

uint64_t decoderMemory(const std::string& codec, const std::string& path) {
  const std::vector<std::byte> bytes = native::readFile(path);
  std::ofstream("/proc/self/clear_refs") << "5";  // resets the peak
  const uint64_t before = status("VmRSS");
  if (codec == "draco") {
    decodeDraco(bytes);
  } else {
    const Decoder decoder = decodeIsostar(bytes);
    const Mesh mesh = meshOf(decoder, false);
  }
  return status("VmHWM") - before;
}

}  // namespace isostar::bench
