// Arbitrary bytes as a stream, with repaired checksums: damage anywhere in a sound stream reaches
// the decoder.
#include "fuzz_input.h"
#include "hostile/mended_checksums.h"

using namespace isostar;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  const auto all = FuzzInput(data, size).rest();
  std::vector<std::byte> stream(all.begin(), all.end());
  mendChecksums(stream);
  demandHarmless(stream);
  return 0;
}
