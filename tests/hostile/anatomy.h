// Where things are in a stream, so that one can be damaged in a known place and its checksums repaired.
#pragma once

#include "property/round_trip.h"
#include "stream.h"

namespace isostar {

struct Anatomy {
  struct Layer {
    std::size_t head, payload, end;
  };
  Header header;
  std::size_t headerEnd = 0;
  std::vector<Layer> layers;
  std::vector<LayerHead> heads;

  explicit Anatomy(std::span<const std::byte> bytes) {
    EXPECT_EQ(read(bytes, header, headerEnd), Error::None);
    for (std::size_t at = headerEnd; layers.size() < header.layers;) {
      LayerHead head;
      std::size_t used = 0;
      if (read(bytes.subspan(at), header, head, used) != Error::None) break;
      layers.push_back({at, at + used, at + used + static_cast<std::size_t>(head.bytes)});
      heads.push_back(head);
      at = layers.back().end;
    }
  }
};

inline void putChecksum(Bytes& bytes, std::size_t at, uint32_t sum) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(sum >> (8 * i) & 0xFF);
}

/// The same damage under checksums that are right again, where the stream was as `anatomy` says.
inline Bytes repaired(Bytes bytes, const Anatomy& anatomy) {
  const std::span<const std::byte> all(bytes);
  constexpr std::size_t kMagic = 4, kSum = 4;
  putChecksum(bytes, anatomy.headerEnd - kSum, checksum(all.subspan(kMagic, anatomy.headerEnd - kMagic - kSum)));
  for (const auto& layer : anatomy.layers)
    putChecksum(bytes, layer.payload - kSum, checksum(all.subspan(layer.payload, layer.end - layer.payload)));
  return bytes;
}

/// A stream of a header and of layers as they are given, with the checksums that they should have.
inline Bytes assembled(Header header, const std::vector<std::pair<LayerHead, Bytes>>& layers) {
  Bytes bytes;
  ByteWriter out(bytes);
  header.layers = static_cast<uint32_t>(layers.size());
  write(out, header);
  for (auto [head, payload] : layers) {
    head.bytes = payload.size();
    head.checksum = checksum(payload);
    write(out, head);
    bytes.insert(bytes.end(), payload.begin(), payload.end());
  }
  return bytes;
}

}  // namespace isostar
