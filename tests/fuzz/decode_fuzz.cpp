// Arbitrary bytes as a stream.
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  isostar::demandHarmless(isostar::FuzzInput(data, size).rest());
  return 0;
}
