// The index of a stream in chunks: what its layers are, and how long the sections of their chunks.
#pragma once

#include "container/stream.h"

namespace isostar {

/// Of a layer.
inline constexpr uint64_t kMostSections = 1u << 22;
/// A layer of more chunks has pages, one for so many chunks in the order of their numbers.
inline constexpr uint64_t kChunksPerPage = 512;

/// The sections of a layer of a stream in chunks.
using LayerSections = std::vector<std::vector<std::byte>>;
/// Appends index, pages and layers of a stream in chunks. `header`: that of the stream but for its
/// length; the heads' lengths are not read either.
void append(std::vector<std::byte>& out, const Header& header, std::span<const LayerHead> heads,
            const std::vector<LayerSections>& layers);

/// The heads of all layers of a stream in chunks, without what pages name.
struct Index {
  std::vector<LayerHead> heads;
  uint32_t identity = 0;  // what the checksums of this stream's sections start with
  std::size_t end = 0;    // where in the stream the first layer begins, or its first page
};
/// Of an index that has been read, and of the longest list of sections that pages name: a layer's
/// list is copied while the layer is decoded.
[[nodiscard]] uint64_t memoryOf(std::span<const LayerHead> heads, const Header& header);
/// Reads the entries of an index, up to its checksum. OverLimit if memoryOf() them exceeds `memory`
/// bytes.
[[nodiscard]] Error readEntries(ByteReader& in, const Header& header, uint64_t memory,
                                std::vector<LayerHead>& out);
/// Reads the index that begins at `start`, behind the header. Errors: as above.
[[nodiscard]] Error readIndex(std::span<const std::byte> stream, std::size_t start,
                              const Header& header, uint64_t memory, Index& out);

/// The length of a section's or a page's checksum, which precedes it.
[[nodiscard]] std::size_t checksumBytes(uint64_t length);
/// Of a section of a stream in chunks: its layer and chunk by number.
[[nodiscard]] uint32_t checksum(uint32_t identity, std::size_t layer, std::size_t chunk,
                                std::span<const std::byte> section);
/// Of a page with its checksum.
[[nodiscard]] uint64_t wholeBytes(const IndexPage& page);
/// Of all pages of a layer.
[[nodiscard]] uint64_t pageBytes(const LayerHead& head);
/// The page's checksum, by its number.
[[nodiscard]] uint32_t pageChecksum(uint32_t identity, std::size_t layer, std::size_t page,
                                    std::span<const std::byte> bytes);
/// Reads a page of the layer with this head: wholeBytes() of `bytes`. head.sections has an entry
/// for each chunk; those of the page's chunks are set. Corrupt: the page is damaged.
[[nodiscard]] Error readPage(std::span<const std::byte> bytes, uint32_t identity, std::size_t layer,
                             std::size_t page, LayerHead& head);

}  // namespace isostar
