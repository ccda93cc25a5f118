// Arbitrary bytes as a volume of the format ISOSTAR_EXTENSION, read by ISOSTAR_READER in this
// process, where the command line starts a child for it.
#include <exception>

#include "fuzz_file.h"
#include "fuzz_input.h"
#include "volume/named_files.h"
#include "volume/volume_formats.h"

using namespace isostar;

namespace {

void demandSound(const native::LoadedVolume& volume) {
  uint64_t samples = static_cast<uint64_t>(volume.frames);
  for (const int32_t n : volume.size) {
    demand(n >= 1);
    samples *= static_cast<uint64_t>(n);
  }
  demand(volume.samples.size() == samples);
  for (const float sample : volume.samples) demand(std::isfinite(sample));
}

}  // namespace

/// ITK's readers leak on damaged files, and ask for as much memory as these claim. A child gets
/// about 1 GB.
extern "C" const char* __asan_default_options() {
  return "detect_leaks=0:allocator_may_return_null=1:max_allocation_size_mb=1024";
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  static const FuzzFile file(ISOSTAR_EXTENSION);
  file.write(data, size);
  try {
    native::requireRegularFiles(file.path());
    demandSound(native::ISOSTAR_READER(file.path()));
  } catch (const std::exception&) {
    // A child reports any of them as a failure.
  }
  return 0;
}
