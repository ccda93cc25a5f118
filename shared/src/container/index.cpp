// Reads the index of streams in chunks, and its pages.
#include "container/index.h"

#include <algorithm>

#include "container/crc.h"
#include "container/layer_fields.h"

namespace isostar {
namespace {

constexpr uint64_t kShort = 1024;                 // shorter sections have checksums of 16 bits
constexpr uint64_t kLongest = uint64_t{1} << 40;  // of a section, so that sums do not overflow
constexpr uint64_t kMostInPage = kChunksPerPage * (kLongest + 4);
constexpr uint64_t kLongestPage = kChunksPerPage * 6;
constexpr uint64_t kBytesPerSection = 2 * sizeof(uint64_t);
constexpr uint32_t kMostFilter = 2;

/// Calls visit(length) for the lengths of the next `chunks` sections, and adds up their bytes with
/// checksums. Corrupt or Truncated: fewer could be read.
template <class Visit>
Error readLengths(ByteReader& in, uint64_t chunks, uint64_t& sum, Visit visit) {
  for (uint64_t chunk = 0; chunk < chunks; ++chunk) {
    const uint64_t length = in.varint();
    if (in.malformed() || length > kLongest) return Error::Corrupt;
    if (in.overrun()) return Error::Truncated;
    visit(length);
    sum += length + checksumBytes(length);
  }
  return Error::None;
}

/// Of a layer that has pages.
Error readPages(ByteReader& in, uint64_t pages, LayerHead& head) {
  head.pages.reserve(static_cast<std::size_t>(std::min<uint64_t>(pages, in.left())));
  while (head.pages.size() < pages) {
    IndexPage page{in.varint()};
    if (page.bytes != 0) page.sections = in.varint();
    if (in.malformed() || page.bytes > kLongestPage || page.sections > kMostInPage)
      return Error::Corrupt;
    if (in.overrun()) return Error::Truncated;
    head.pages.push_back(page);
    head.bytes += page.sections;
  }
  return Error::None;
}

/// OverLimit if its lists take more than `memory` bytes. Corrupt if the entry does not fit the
/// header; otherwise `in` may have come to its end.
Error readHead(ByteReader& in, const Header& header, uint64_t memory, LayerHead& head) {
  const uint32_t first = in.u8(), error = in.u8();
  if (in.overrun()) return Error::Truncated;
  if (!readFields(first, error, header, head)) return Error::Corrupt;
  const uint64_t chunks = header.chunks(head.level);
  if (chunks > kMostSections) return Error::Corrupt;
  if (hasFilter(head.kind, chunks)) head.filter = static_cast<uint8_t>(in.u8());
  if (head.filter > kMostFilter) return Error::Corrupt;
  if (chunks * kBytesPerSection > memory) return Error::OverLimit;
  if (chunks > kChunksPerPage)
    return readPages(in, (chunks + kChunksPerPage - 1) / kChunksPerPage, head);
  head.sections.reserve(static_cast<std::size_t>(std::min<uint64_t>(chunks, in.left())));
  return readLengths(in, chunks, head.bytes,
                     [&](uint64_t length) { head.sections.push_back(length); });
}

uint32_t seededChecksum(std::initializer_list<uint64_t> seeds, std::span<const std::byte> bytes) {
  const auto sumOf = [&](auto crc) -> uint32_t {
    for (const uint64_t number : seeds) {
      for (int shift = 0; shift < 32; shift += 8) crc.add(static_cast<uint8_t>(number >> shift));
    }
    crc.add(bytes);
    return crc.sum();
  };
  return bytes.size() < kShort ? sumOf(Crc16()) : sumOf(Crc32());
}

}  // namespace

uint64_t memoryOf(std::span<const LayerHead> heads, const Header& header) {
  uint64_t sum = 0, longest = 0;
  for (const LayerHead& head : heads) {
    sum += head.pages.size() * sizeof(IndexPage);
    const uint64_t lists = header.chunks(head.level) * kBytesPerSection;
    if (head.pages.empty())
      sum += lists;
    else
      longest = std::max(longest, lists);
  }
  return sum + longest;
}

Error readEntries(ByteReader& in, const Header& header, uint64_t memory,
                  std::vector<LayerHead>& out) {
  std::vector<LayerHead> heads(in.u8());
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const uint64_t used = memoryOf(std::span(heads).first(i), header);
    if (used > memory) return Error::OverLimit;
    if (const Error error = readHead(in, header, memory - used, heads[i]); error != Error::None)
      return error;
  }
  if (memoryOf(heads, header) > memory) return Error::OverLimit;
  out = std::move(heads);
  return in.overrun() ? Error::Truncated : Error::None;
}

Error readIndex(std::span<const std::byte> stream, std::size_t start, const Header& header,
                uint64_t memory, Index& out) {
  ByteReader r(stream.subspan(start));
  std::vector<LayerHead> heads;
  if (const Error error = readEntries(r, header, memory, heads); error != Error::None) return error;
  uint64_t left = header.bytes;
  for (const LayerHead& head : heads) {
    const uint64_t bytes = pageBytes(head) + head.bytes;
    if (bytes > left) return Error::Corrupt;
    left -= bytes;
  }
  const std::size_t length = r.position();
  const uint32_t sum = r.u32();
  if (r.overrun()) return Error::Truncated;
  Crc32 crc;
  crc.add(stream.first(start + length));
  if (sum != crc.sum() || r.position() != left) return Error::Corrupt;
  out = {std::move(heads), sum, start + r.position()};
  return Error::None;
}

std::size_t checksumBytes(uint64_t length) {
  return length == 0 ? 0 : length < kShort ? 2 : 4;
}

uint32_t checksum(uint32_t identity, std::size_t layer, std::size_t chunk,
                  std::span<const std::byte> section) {
  return seededChecksum({identity, layer, chunk}, section);
}

uint64_t wholeBytes(const IndexPage& page) {
  return checksumBytes(page.bytes) + page.bytes;
}

uint64_t pageBytes(const LayerHead& head) {
  uint64_t sum = 0;
  for (const IndexPage& page : head.pages) sum += wholeBytes(page);
  return sum;
}

uint32_t pageChecksum(uint32_t identity, std::size_t layer, std::size_t page,
                      std::span<const std::byte> bytes) {
  return checksum(identity, layer, static_cast<std::size_t>(kMostSections) + page, bytes);
}

Error readPage(std::span<const std::byte> bytes, uint32_t identity, std::size_t layer,
               std::size_t page, LayerHead& head) {
  if (bytes.empty()) return Error::None;
  ByteReader in(bytes);
  const std::size_t length = checksumBytes(head.pages[page].bytes);
  const uint32_t sum = length == 2 ? in.u16() : in.u32();
  if (sum != pageChecksum(identity, layer, page, bytes.subspan(length))) return Error::Corrupt;
  const auto first = page * static_cast<std::size_t>(kChunksPerPage);
  auto next = head.sections.begin() + static_cast<std::ptrdiff_t>(first);
  uint64_t sections = 0;
  const Error error =
      readLengths(in, std::min<uint64_t>(kChunksPerPage, head.sections.size() - first), sections,
                  [&](uint64_t section) { *next++ = section; });
  const bool isRight =
      error == Error::None && in.left() == 0 && sections == head.pages[page].sections;
  return isRight ? Error::None : Error::Corrupt;
}

}  // namespace isostar
