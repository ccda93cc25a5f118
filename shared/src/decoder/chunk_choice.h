// Which chunks of a stream are decoded.
#pragma once

#include <optional>

#include "container/stream.h"

namespace isostar {

/// Chunks between two places on each axis, both included.
struct ChunkBox {
  std::array<int32_t, 3> first, last, count;  // count: of the level

  [[nodiscard]] bool has(std::size_t chunk) const;
};

/// All chunks, or those that a region takes: the chunks that own the ends of its edges, and on each
/// level before, all that these see.
class ChunkChoice {
 public:
  /// `region`: nothing for all chunks.
  ChunkChoice(const Header& header, const std::optional<Region>& region);

  [[nodiscard]] bool has(const LayerHead& head, std::size_t chunk) const;
  /// Is any chunk of a layer chosen?
  [[nodiscard]] bool hasAny(const LayerHead& head) const;
  /// The bytes of a layer that are wanted.
  [[nodiscard]] uint64_t bytes(const LayerHead& head) const;
  /// Where the chosen bytes of layers lie, of which the first one begins at `start`.
  [[nodiscard]] std::vector<ByteRange> ranges(std::span<const LayerHead> heads,
                                              uint64_t start) const;

 private:
  int finestLevel_ = 0;
  bool isNone_ = false;          // the region lies beside the volume
  std::vector<ChunkBox> signs_;  // by level; empty: all chunks
  ChunkBox geometry_{};          // of the finest level
};

}  // namespace isostar
