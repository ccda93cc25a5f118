// Which chunks of a stream are decoded.
#pragma once

#include <optional>

#include "container/index.h"
#include "grid/lattice.h"

namespace isostar {

/// Chunks between two places on each axis, both included.
struct ChunkBox {
  Coordinates<3> first, last, count;  // count: of the level

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
  /// Are all bytes of all layers chosen?
  [[nodiscard]] bool isWhole() const { return signs_.empty(); }
  /// Does a page name any chosen chunk?
  [[nodiscard]] bool hasPage(const LayerHead& head, std::size_t page) const;
  /// The bytes of a layer's pages that are wanted.
  [[nodiscard]] uint64_t bytesOfPages(const LayerHead& head) const;
  /// The bytes of a layer that are wanted, behind its pages.
  [[nodiscard]] uint64_t bytes(const LayerHead& head) const;
  /// Adds where the wanted bytes of a layer lie, which begins, or whose pages begin, at `start`.
  /// False if they are not known before its pages are read: then only these.
  bool addRanges(const LayerHead& head, uint64_t start, std::vector<ByteRange>& ranges) const;

 private:
  [[nodiscard]] const ChunkBox& boxOf(const LayerHead& head) const;

  int finestLevel_ = 0;
  bool isNone_ = false;          // the region lies beside the volume
  std::vector<ChunkBox> signs_;  // by level; empty: all chunks
  ChunkBox geometry_{};          // of the finest level
};

}  // namespace isostar
