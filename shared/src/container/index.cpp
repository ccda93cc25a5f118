// Reads and writes the index and the sections of streams in chunks.
#include "container/crc.h"
#include "container/layer_fields.h"
#include "container/stream.h"

namespace isostar {
namespace {

constexpr uint64_t kShort = 1024;          // shorter sections have checksums of 16 bits
constexpr uint64_t kLongest = 1ull << 40;  // of a section, so that sums do not overflow
constexpr uint32_t kMostFilter = 2;

/// Does the head of a layer say how its level is shown? A refinement of one chunk codes it.
bool hasFilter(LayerKind kind, uint64_t chunks) {
  return kind == LayerKind::Refinement && chunks > 1;
}

/// OverLimit if it has more than `most` sections. Corrupt if the entry does not fit the header;
/// otherwise `in` may have come to its end.
Error readHead(ByteReader& in, const Header& header, uint64_t most, LayerHead& head) {
  const uint32_t first = in.u8(), error = in.u8();
  if (in.overrun()) return Error::Truncated;
  if (!readFields(first, error, header, head)) return Error::Corrupt;
  const uint64_t chunks = header.chunks(head.level);
  if (chunks > kMostSections) return Error::Corrupt;
  if (hasFilter(head.kind, chunks)) head.filter = static_cast<uint8_t>(in.u8());
  if (head.filter > kMostFilter) return Error::Corrupt;
  if (chunks > most) return Error::OverLimit;
  head.sections.reserve(static_cast<std::size_t>(std::min<uint64_t>(chunks, in.left())));
  for (uint64_t chunk = 0; chunk < chunks && !in.overrun(); ++chunk) {
    const uint64_t length = in.varint();
    if (in.malformed() || length > kLongest) return Error::Corrupt;
    head.sections.push_back(length);
    head.bytes += length + checksumBytes(length);
  }
  return in.overrun() ? Error::Truncated : Error::None;
}

}  // namespace

std::size_t checksumBytes(uint64_t section) {
  return section == 0 ? 0 : section < kShort ? 2 : 4;
}

uint32_t checksum(uint32_t identity, std::size_t layer, std::size_t chunk,
                  std::span<const std::byte> section) {
  const auto sumOf = [&](auto crc) -> uint32_t {
    for (const uint64_t number : {uint64_t{identity}, uint64_t{layer}, uint64_t{chunk}}) {
      for (int shift = 0; shift < 32; shift += 8) crc.add(static_cast<uint8_t>(number >> shift));
    }
    crc.add(section);
    return crc.sum();
  };
  return section.size() < kShort ? sumOf(Crc16()) : sumOf(Crc32());
}

void append(std::vector<std::byte>& out, const Header& header, std::vector<LayerHead> heads,
            const std::vector<LayerSections>& layers) {
  std::vector<std::byte> index;
  ByteWriter entries(index);
  uint64_t sections = 0;
  entries.u8(heads.size());
  for (std::size_t i = 0; i < heads.size(); ++i) {
    writeFields(entries, heads[i]);
    if (hasFilter(heads[i].kind, layers[i].size())) entries.u8(heads[i].filter);
    for (const auto& section : layers[i]) {
      entries.varint(section.size());
      sections += section.size() + checksumBytes(section.size());
    }
  }
  constexpr std::size_t kSum = 4;
  Header whole = header;
  whole.bytes = index.size() + kSum + sections;
  const std::size_t start = out.size();
  ByteWriter writer(out);
  write(writer, whole);
  out.insert(out.end(), index.begin(), index.end());
  Crc32 crc;
  crc.add(std::span<const std::byte>(out).subspan(start));
  const uint32_t identity = crc.sum();
  writer.u32(identity);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    for (std::size_t chunk = 0; chunk < layers[i].size(); ++chunk) {
      const auto& section = layers[i][chunk];
      const uint32_t sum = checksum(identity, i, chunk, section);
      if (checksumBytes(section.size()) == 2) writer.u16(sum);
      if (checksumBytes(section.size()) == 4) writer.u32(sum);
      out.insert(out.end(), section.begin(), section.end());
    }
  }
}

Error readEntries(ByteReader& in, const Header& header, uint64_t memory,
                  std::vector<LayerHead>& out) {
  std::vector<LayerHead> heads(in.u8());
  uint64_t most = memory / kBytesPerSection;
  for (LayerHead& head : heads) {
    if (const Error error = readHead(in, header, most, head); error != Error::None) return error;
    most -= head.sections.size();
  }
  out = std::move(heads);
  return in.overrun() ? Error::Truncated : Error::None;
}

Error readIndex(std::span<const std::byte> stream, std::size_t start, const Header& header,
                uint64_t memory, Index& out) {
  ByteReader r(stream.subspan(start));
  std::vector<LayerHead> heads;
  if (const Error error = readEntries(r, header, memory, heads); error != Error::None) return error;
  uint64_t bytes = 0;
  for (const LayerHead& head : heads) {
    if (head.bytes > header.bytes - bytes) return Error::Corrupt;
    bytes += head.bytes;
  }
  const std::size_t length = r.position();
  const uint32_t sum = r.u32();
  if (r.overrun()) return Error::Truncated;
  Crc32 crc;
  crc.add(stream.first(start + length));
  if (sum != crc.sum() || r.position() + bytes != header.bytes) return Error::Corrupt;
  out = {std::move(heads), sum, start + r.position()};
  return Error::None;
}

}  // namespace isostar
