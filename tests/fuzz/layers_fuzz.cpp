// Any layers behind a plausible header and right checksums: straight into the traversals.
#include "fuzz_input.h"
#include "stream.h"

using namespace isostar;

namespace {

Header headerFrom(FuzzInput& input) {
  Header header;
  for (int32_t& n : header.size) n = input.between(1, 40);
  header.octaves = input.between(0, 4);
  header.quantum = (input.byte() & 1) != 0 ? 1 : 0.001;
  return header;
}

void writeLayer(FuzzInput& input, const Header& header, std::vector<std::byte>& stream) {
  LayerHead head;
  head.kind = static_cast<LayerKind>(input.between(0, 3));
  head.level = input.between(0, header.octaves);
  const auto payload = input.bytes(static_cast<std::size_t>(input.byte()));
  head.bytes = payload.size();
  head.checksum = checksum(payload);
  ByteWriter out(stream);
  write(out, head);
  stream.insert(stream.end(), payload.begin(), payload.end());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  Header header = headerFrom(input);
  header.layers = static_cast<uint32_t>(input.between(0, 20));
  std::vector<std::byte> stream;
  ByteWriter out(stream);
  write(out, header);
  for (uint32_t i = 0; i < header.layers; ++i) writeLayer(input, header, stream);
  demandHarmless(stream);
  return 0;
}
