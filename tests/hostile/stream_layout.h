// Where the parts of a stream are, so that a test can damage one of them and repair the checksums.
#pragma once

#include "mended_checksums.h"
#include "property/round_trip.h"

namespace isostar {

/// Of a stream in chunks only the header's end is known.
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
    for (std::size_t at = headerEnd; header.chunkSide == 0 && at < headerEnd + header.bytes;) {
      LayerHead head;
      std::size_t used = 0;
      if (read(bytes.subspan(at), header, head, used) != Error::None) break;
      layers.push_back({at, at + used, at + used + static_cast<std::size_t>(head.bytes)});
      heads.push_back(head);
      at = layers.back().end;
    }
  }
};

/// The damaged stream with correct checksums. `layout`: of the undamaged stream.
inline Bytes repaired(Bytes bytes, const StreamLayout& layout) {
  if (layout.header.chunkSide != 0) {
    mendChecksums(bytes);
    return bytes;
  }
  const std::span<const std::byte> all(bytes);
  constexpr std::size_t kMagic = 3, kSum = 2;
  putChecksum(bytes, layout.headerEnd - kSum, kSum,
              checksum(all.subspan(kMagic, layout.headerEnd - kMagic - kSum)));
  for (std::size_t i = 0; i < layout.layers.size(); ++i) {
    const auto& layer = layout.layers[i];
    LayerHead head;
    std::size_t used = 0;
    if (read(all.subspan(layer.head), layout.header, head, used) != Error::None) continue;
    const std::size_t length = layer.end - layer.payload, sum = length < 1024 ? 2 : 4;
    putChecksum(bytes, layer.payload - sum, sum,
                checksum(head, all.subspan(layer.payload, length), i));
  }
  return bytes;
}

/// The layers of a stream without their heads' bytes.
using Layers = std::vector<std::pair<LayerHead, Bytes>>;

inline Layers layersOf(std::span<const std::byte> bytes, const StreamLayout& layout) {
  Layers layers;
  for (std::size_t i = 0; i < layout.layers.size(); ++i) {
    const auto& at = layout.layers[i];
    const auto layer = bytes.subspan(at.payload, at.end - at.payload);
    layers.emplace_back(layout.heads[i], Bytes(layer.begin(), layer.end()));
  }
  return layers;
}

/// A stream of a header and of given layers, with correct sizes and checksums.
inline Bytes assembled(Header header, const Layers& layers) {
  Bytes behind;
  for (std::size_t i = 0; i < layers.size(); ++i)
    append(behind, layers[i].first, layers[i].second, i);
  header.bytes = behind.size();
  Bytes bytes;
  ByteWriter whole(bytes);
  write(whole, header);
  bytes.insert(bytes.end(), behind.begin(), behind.end());
  return bytes;
}

}  // namespace isostar
