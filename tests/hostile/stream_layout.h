// Where the parts of a stream are, so that a test can damage one of them and repair the checksums.
#pragma once

#include "container/stream.h"
#include "property/round_trip.h"

namespace isostar {

struct StreamLayout {
  struct Layer {
    std::size_t head, payload, end;
  };
  Header header;
  std::size_t headerEnd = 0;
  std::vector<Layer> layers;
  std::vector<LayerHead> heads;

  explicit StreamLayout(std::span<const std::byte> bytes) {
    EXPECT_EQ(read(bytes, header, headerEnd), Error::None);
    for (std::size_t at = headerEnd; at < headerEnd + header.bytes;) {
      LayerHead head;
      std::size_t used = 0;
      if (read(bytes.subspan(at), header, head, used) != Error::None) break;
      layers.push_back({at, at + used, at + used + static_cast<std::size_t>(head.bytes)});
      heads.push_back(head);
      at = layers.back().end;
    }
  }
};

inline void putChecksum(Bytes& bytes, std::size_t at, std::size_t length, uint32_t sum) {
  for (std::size_t i = 0; i < length; ++i)
    bytes[at + i] = static_cast<std::byte>(sum >> (8 * i) & 0xFF);
}

/// The damaged stream with correct checksums. `layout`: of the undamaged stream.
inline Bytes repaired(Bytes bytes, const StreamLayout& layout) {
  const std::span<const std::byte> all(bytes);
  constexpr std::size_t kMagic = 3, kSum = 2;
  putChecksum(bytes, layout.headerEnd - kSum, kSum,
              checksum(all.subspan(kMagic, layout.headerEnd - kMagic - kSum)));
  for (const auto& layer : layout.layers) {
    LayerHead head;
    std::size_t used = 0;
    if (read(all.subspan(layer.head), layout.header, head, used) != Error::None) continue;
    const std::size_t length = layer.end - layer.payload, sum = length < 1024 ? 2 : 4;
    putChecksum(bytes, layer.payload - sum, sum,
                checksum(head, all.subspan(layer.payload, length)));
  }
  return bytes;
}

/// A stream of a header and of given layers, with correct sizes and checksums.
inline Bytes assembled(Header header, const std::vector<std::pair<LayerHead, Bytes>>& layers) {
  Bytes behind;
  ByteWriter out(behind);
  for (auto [head, payload] : layers) {
    head.bytes = payload.size();
    head.checksum = checksum(head, payload);
    write(out, head);
    behind.insert(behind.end(), payload.begin(), payload.end());
  }
  header.bytes = behind.size();
  Bytes bytes;
  ByteWriter whole(bytes);
  write(whole, header);
  bytes.insert(bytes.end(), behind.begin(), behind.end());
  return bytes;
}

}  // namespace isostar
