// Arbitrary bytes as a stream, with repaired checksums: damage anywhere in a sound stream reaches
// the decoder.
#include <algorithm>

#include "container/stream.h"
#include "fuzz_input.h"

using namespace isostar;

namespace {

using Bytes = std::vector<std::byte>;
constexpr std::size_t kMagic = 3, kShort = 1024;

void put(Bytes& stream, std::size_t at, std::size_t length, uint32_t sum) {
  for (std::size_t i = 0; i < length; ++i)
    stream[at + i] = static_cast<std::byte>(sum >> (8 * i) & 0xFF);
}

/// The length of a header depends on its fields, so every position is tried for its checksum. 0 if
/// none fits.
std::size_t mendHeader(Bytes& stream, Header& header) {
  constexpr std::size_t kLongest = 400;
  for (std::size_t end = kMagic + 1; end + 2 <= std::min(stream.size(), kLongest); ++end) {
    const uint32_t sum = checksum(std::span<const std::byte>(stream).subspan(kMagic, end - kMagic));
    const std::array<std::byte, 2> before{stream[end], stream[end + 1]};
    put(stream, end, 2, sum);
    std::size_t used = 0;
    if (read(stream, header, used) == Error::None && used == end + 2) return used;
    std::copy(before.begin(), before.end(), stream.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return 0;
}

void mend(Bytes& stream) {
  Header header;
  std::size_t at = mendHeader(stream, header);
  while (at != 0 && at < stream.size()) {
    LayerHead head;
    std::size_t used = 0;
    if (read(std::span<const std::byte>(stream).subspan(at), header, head, used) != Error::None)
      return;
    at += used;
    if (head.bytes > stream.size() - at) return;
    const auto layer =
        std::span<const std::byte>(stream).subspan(at, static_cast<std::size_t>(head.bytes));
    const std::size_t length = layer.size() < kShort ? 2 : 4;
    put(stream, at - length, length, checksum(head, layer));
    at += layer.size();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  const auto all = FuzzInput(data, size).rest();
  Bytes stream(all.begin(), all.end());
  mend(stream);
  demandHarmless(stream);
  return 0;
}
