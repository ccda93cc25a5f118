// A stream as a whole and in pieces gives the same layers and the same surface.
#include <utility>

#include "fuzz_input.h"

using namespace isostar;

namespace {

struct Outcome {
  Error error;
  uint64_t bytes;
  std::vector<float> positions;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcomeOf(Decoder& decoder) {
  decoder.finish();
  while (decoder.advance()) {
  }
  Mesh mesh;
  (void)decoder.mesh({Polygonizer::Cubes, Frame::Grid, false}, mesh);
  return {decoder.error(), decoder.bytes(), mesh.positions};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  const std::size_t first = input.byte(), next = std::size_t{input.byte()} + 1;
  const auto stream = input.rest();
  Decoder whole(kFuzzLimits), pieces(kFuzzLimits);
  whole.accept(stream);
  for (std::size_t at = 0, length = first; at < stream.size(); at += std::exchange(length, next)) {
    pieces.accept(stream.subspan(at, std::min(length, stream.size() - at)));
    (void)pieces.advance();
  }
  demand(outcomeOf(whole) == outcomeOf(pieces));
  return 0;
}
