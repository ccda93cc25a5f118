// Arbitrary samples without a header, of an arbitrary size and type.
#include "files/failure.h"
#include "fuzz_file.h"
#include "fuzz_input.h"
#include "volume/volume_formats.h"

using namespace isostar;

namespace {

/// Mostly a size that a short file can have.
int64_t sideFrom(FuzzInput& input) {
  return input.between(0, 7) == 0 ? input.number<int64_t>() : input.between(1, 9);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  static const FuzzFile file(".raw");
  FuzzInput input(data, size);
  native::VolumeRequest request{.path = file.path()};
  request.type = static_cast<native::SampleType>(input.between(0, 9));
  const int64_t x = sideFrom(input), y = sideFrom(input), z = sideFrom(input);
  request.size = native::ClaimedSize{x, y, z};
  const auto rest = input.rest();
  file.write(reinterpret_cast<const uint8_t*>(rest.data()), rest.size());
  try {
    const native::LoadedVolume volume = native::readRaw(request);
    demand(volume.samples.size() ==
           static_cast<uint64_t>(x) * static_cast<uint64_t>(y) * static_cast<uint64_t>(z));
    for (const float sample : volume.samples) demand(std::isfinite(sample));
  } catch (const native::Failure&) {
    // The only exception that may leave a reader which runs in no child process.
  }
  return 0;
}
