// Any layers behind a plausible header and right checksums: straight into the traversals.
#include "fuzz_input.h"
#include "stream.h"

using namespace isostar;

namespace {

Header headerFrom(FuzzInput& input) {
  Header header;
  header.dimension = input.between(2, 4);
  for (int32_t& n : header.size) n = input.between(1, header.dimension == 4 ? 20 : 40);
  for (int i = input.between(0, 3); i > 0; --i) header.near.push_back(input.between(-9, 9));
  if ((input.byte() & 1) != 0) header.countWhole(1);
  else header.quantum = 0x1p-10;
  return header;
}

void writeLayer(FuzzInput& input, const Header& header, std::vector<std::byte>& stream) {
  LayerHead head;
  head.kind = static_cast<LayerKind>(input.between(0, 7));
  head.level = input.between(0, std::max(header.octaves(), 3));
  const auto payload = input.bytes(static_cast<std::size_t>(input.byte()));
  head.bytes = payload.size();
  head.checksum = checksum(head, payload);
  ByteWriter out(stream);
  write(out, head);
  stream.insert(stream.end(), payload.begin(), payload.end());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  Header header = headerFrom(input);
  std::vector<std::byte> layers, stream;
  for (int i = input.between(0, 20); i > 0; --i) writeLayer(input, header, layers);
  header.bytes = layers.size();
  ByteWriter out(stream);
  write(out, header);
  stream.insert(stream.end(), layers.begin(), layers.end());
  demandHarmless(stream);
  return 0;
}
