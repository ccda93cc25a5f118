// The container: a header, then layers, each preceded by its head. In a stream in chunks all heads
// stand in front, in the index.
#pragma once

#include <span>
#include <vector>

#include "container/bytes.h"
#include "container/header.h"
#include "container/layer_kind.h"

namespace isostar {

struct LayerHead {
  LayerKind kind = LayerKind::Base;
  int level = 0;     // or the number of a further isovalue
  double error = 0;  // RMS distance to the source's surface, in grid steps, to within 5 %
  uint64_t bytes = 0;
  uint32_t checksum = 0;  // of a layer that is one section without an index
  /// In a stream in chunks: the length of each chunk's section, without its checksum. A chunk of
  /// length 0 has none.
  std::vector<uint64_t> sections = {};
  uint8_t filter = 0;  // of a refinement in several chunks: the level's SmoothingFilter
};

inline constexpr uint64_t kMostLayers = 255;
/// Of a layer.
inline constexpr uint64_t kMostSections = 1u << 22;

/// Does not write an index.
void write(ByteWriter& out, const Header& header);
void write(ByteWriter& out, const LayerHead& head);
/// Appends a layer, which `number` layers precede. Sets the length and the checksum in its head.
void append(std::vector<std::byte>& out, LayerHead head, std::span<const std::byte> layer,
            std::size_t number);

/// Error::Truncated if more bytes are needed; `used` is then not set. Otherwise `used` receives the
/// size of the header or head in bytes.
[[nodiscard]] Error read(std::span<const std::byte> in, Header& out, std::size_t& used);
[[nodiscard]] Error read(std::span<const std::byte> in, const Header& header, LayerHead& out,
                         std::size_t& used);

/// The sections of a layer of a stream in chunks.
using LayerSections = std::vector<std::vector<std::byte>>;
/// Appends index and layers of a stream in chunks. Sets the lengths in the heads. `header`: that of
/// the stream but for its length.
void append(std::vector<std::byte>& out, const Header& header, std::vector<LayerHead> heads,
            const std::vector<LayerSections>& layers);
/// The heads of all layers of a stream in chunks.
struct Index {
  std::vector<LayerHead> heads;
  uint32_t identity = 0;  // what the checksums of this stream's sections start with
  std::size_t end = 0;    // where in the stream the first section begins
};
/// Of a section in an index that has been read; a layer's list is copied while it is decoded.
inline constexpr uint64_t kBytesPerSection = 2 * sizeof(uint64_t);
/// Reads the entries of an index, up to its checksum. OverLimit if their lists take more than
/// `memory` bytes.
[[nodiscard]] Error readEntries(ByteReader& in, const Header& header, uint64_t memory,
                                std::vector<LayerHead>& out);
/// Reads the index that begins at `start`, behind the header. Errors: as above.
[[nodiscard]] Error readIndex(std::span<const std::byte> stream, std::size_t start,
                              const Header& header, uint64_t memory, Index& out);

/// The length of a section's checksum, which precedes it.
[[nodiscard]] std::size_t checksumBytes(uint64_t section);
/// Of a section of a stream in chunks: its layer and chunk by number.
[[nodiscard]] uint32_t checksum(uint32_t identity, std::size_t layer, std::size_t chunk,
                                std::span<const std::byte> section);
/// Of a layer, the other fields of its head and its number: how many layers precede it. 16 bits for
/// a short layer, 32 for others.
[[nodiscard]] uint32_t checksum(const LayerHead& head, std::span<const std::byte> layer,
                                std::size_t number);
/// Of the header's bytes between the first three and the checksum itself; 16 bits.
[[nodiscard]] uint32_t checksum(std::span<const std::byte> header);

}  // namespace isostar
