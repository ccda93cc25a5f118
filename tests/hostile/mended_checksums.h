// Repairs the checksums of damaged streams, so that the damage reaches the decoder.
#pragma once

#include <algorithm>

#include "container/crc.h"
#include "container/index.h"

namespace isostar {

/// Stores a checksum of `length` bytes.
inline void putChecksum(std::vector<std::byte>& stream, std::size_t at, std::size_t length,
                        uint32_t sum) {
  for (std::size_t i = 0; i < length; ++i)
    stream[at + i] = static_cast<std::byte>(sum >> (8 * i) & 0xFF);
}

/// The length of a header depends on its fields, so every position is tried for its checksum. 0 if
/// none fits.
inline std::size_t mendHeader(std::vector<std::byte>& stream, Header& header) {
  constexpr std::size_t kMagic = 3, kSum = 2, kLongest = 400;
  const std::span<const std::byte> all(stream);
  for (std::size_t end = kMagic + 1; end + kSum <= std::min(stream.size(), kLongest); ++end) {
    const std::array<std::byte, kSum> before{stream[end], stream[end + 1]};
    putChecksum(stream, end, kSum, checksum(all.subspan(kMagic, end - kMagic)));
    std::size_t used = 0;
    if (read(all, header, used) == Error::None && used == end + kSum) return used;
    std::copy(before.begin(), before.end(), stream.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return 0;
}

/// Corrects the checksums of a layer's pages that begin at `at`, as far as they are whole, and
/// reads them. False if one cannot be read. `at` receives where they end.
inline bool mendPages(std::vector<std::byte>& stream, std::size_t& at, const Header& header,
                      uint32_t identity, std::size_t layer, LayerHead& head) {
  const std::span<const std::byte> all(stream);
  if (!head.pages.empty()) head.sections.resize(header.chunks(head.level));
  for (std::size_t page = 0; page < head.pages.size(); ++page) {
    const std::size_t length = wholeBytes(head.pages[page]),
                      sum = checksumBytes(head.pages[page].bytes);
    if (length > stream.size() - at) return false;
    const auto bytes = all.subspan(at, length);
    putChecksum(stream, at, sum, pageChecksum(identity, layer, page, bytes.subspan(sum)));
    if (readPage(bytes, identity, layer, page, head) != Error::None) return false;
    at += length;
  }
  return true;
}

/// Corrects the checksums of an index that begins at `at`, and of all pages and sections as far as
/// they are whole.
inline void mendIndex(std::vector<std::byte>& stream, std::size_t at, const Header& header) {
  constexpr std::size_t kSum = 4;
  const std::span<const std::byte> all(stream);
  ByteReader in(all.subspan(at));
  std::vector<LayerHead> heads;
  if (readEntries(in, header, UINT64_MAX, heads) != Error::None) return;
  at += in.position();
  if (stream.size() - at < kSum) return;
  Crc32 crc;
  crc.add(all.first(at));
  putChecksum(stream, at, kSum, crc.sum());
  at += kSum;
  for (std::size_t layer = 0; layer < heads.size(); ++layer) {
    if (!mendPages(stream, at, header, crc.sum(), layer, heads[layer])) return;
    for (std::size_t chunk = 0; chunk < heads[layer].sections.size(); ++chunk) {
      const uint64_t length = heads[layer].sections[chunk];
      const std::size_t sum = checksumBytes(length);
      if (length > stream.size() - at || sum > stream.size() - at - length) return;
      putChecksum(stream, at, sum,
                  checksum(crc.sum(), layer, chunk, all.subspan(at + sum, length)));
      at += sum + static_cast<std::size_t>(length);
    }
  }
}

/// Corrects the checksums of the header and of all layers up to the first head that cannot be read
/// or that states a longer layer than there is.
inline void mendChecksums(std::vector<std::byte>& stream) {
  constexpr std::size_t kShort = 1024;  // shorter layers have checksums of 16 bits
  const std::span<const std::byte> all(stream);
  Header header;
  std::size_t at = mendHeader(stream, header);
  if (at != 0 && header.chunkSide != 0) return mendIndex(stream, at, header);
  for (std::size_t number = 0; at != 0 && at < stream.size(); ++number) {
    LayerHead head;
    std::size_t used = 0;
    if (read(all.subspan(at), header, head, used) != Error::None) return;
    at += used;
    if (head.bytes > stream.size() - at) return;
    const auto layer = all.subspan(at, static_cast<std::size_t>(head.bytes));
    const std::size_t length = layer.size() < kShort ? 2 : 4;
    putChecksum(stream, at - length, length, checksum(head, layer, number));
    at += layer.size();
  }
}

}  // namespace isostar
