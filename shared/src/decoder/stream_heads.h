// Finds the layers of a stream.
#pragma once

#include <algorithm>

#include "container/index.h"
#include "util/cold_path.h"

namespace isostar {

/// The heads of a stream's layers, one after the other: in front of each layer, or in the index.
class StreamHeads {
 public:
  /// The header, and the index if there is one. Truncated: more bytes are needed. OverLimit: the
  /// index takes more than `memory` bytes.
  ISOSTAR_COLD Error begin(std::span<const std::byte> stream, uint64_t memory = UINT64_MAX) {
    Header header;
    std::size_t at = 0;
    if (const Error error = read(stream, header, at); error != Error::None) return error;
    Index index;
    if (header.chunkSide != 0) {
      if (const Error error = readIndex(stream, at, header, memory, index); error != Error::None)
        return error;
    }
    header_ = std::move(header);
    index_ = std::move(index);
    start_ = at;
    return Error::None;
  }

  [[nodiscard]] const Header& header() const { return header_; }
  /// Of all layers of a stream in chunks.
  [[nodiscard]] std::span<const LayerHead> indexed() const { return index_.heads; }
  /// Bytes of the index.
  [[nodiscard]] uint64_t memory() const { return memoryOf(index_.heads, header_); }
  [[nodiscard]] uint32_t identity() const { return index_.identity; }
  /// Where the header ends, with the index.
  [[nodiscard]] std::size_t start() const { return header_.chunkSide != 0 ? index_.end : start_; }
  [[nodiscard]] uint64_t end() const { return start_ + header_.bytes; }

  /// Is `at`, where the number `layer` would begin, behind the last one? Layers in chunks may have
  /// no bytes.
  [[nodiscard]] bool isEnd(std::size_t at, std::size_t layer) const {
    return header_.chunkSide != 0 ? layer == index_.heads.size() : at == end();
  }
  /// Reads the head of the layer that begins at `at`, the number `layer` of the stream. Corrupt if
  /// head and layer do not fit into the rest. `used`: the bytes of the head, or those of its pages,
  /// which are not read.
  ISOSTAR_COLD Error next(std::span<const std::byte> stream, std::size_t at, std::size_t layer,
                          LayerHead& head, std::size_t& used) const {
    if (layer == kMostLayers) return Error::Corrupt;
    if (header_.chunkSide != 0) {
      if (layer == index_.heads.size()) return Error::Corrupt;
      head = index_.heads[layer];
      used = static_cast<std::size_t>(pageBytes(head));
      return Error::None;
    }
    const uint64_t left = end() - at;
    const auto arrived = stream.subspan(at);
    const Error error =
        read(arrived.first(std::min<uint64_t>(arrived.size(), left)), header_, head, used);
    if (error == Error::Truncated && arrived.size() >= left) return Error::Corrupt;
    return error == Error::None && head.bytes > left - used ? Error::Corrupt : error;
  }

 private:
  Header header_;
  Index index_;
  std::size_t start_ = 0;
};

}  // namespace isostar
