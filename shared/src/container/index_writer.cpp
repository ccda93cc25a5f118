// Writes streams in chunks: header, index, pages and sections.
#include <algorithm>

#include "container/crc.h"
#include "container/index.h"
#include "container/layer_fields.h"

namespace isostar {
namespace {

using Bytes = std::vector<std::byte>;

/// The lengths of the sections of some chunks, and with their checksums their sum.
struct Lengths {
  Bytes bytes;
  uint64_t sections = 0;
};

Lengths lengthsOf(std::span<const Bytes> sections) {
  Lengths lengths;
  ByteWriter writer(lengths.bytes);
  for (const Bytes& section : sections) {
    writer.varint(section.size());
    lengths.sections += section.size() + checksumBytes(section.size());
  }
  return lengths;
}

/// The pages of a layer; none of a short one. A page whose chunks have no sections has no bytes.
std::vector<Lengths> pagesOf(const LayerSections& sections) {
  std::vector<Lengths> pages;
  const std::span<const Bytes> all(sections);
  for (std::size_t i = 0; all.size() > kChunksPerPage && i < all.size(); i += kChunksPerPage) {
    pages.push_back(
        lengthsOf(all.subspan(i, std::min<std::size_t>(kChunksPerPage, all.size() - i))));
    if (pages.back().sections == 0) pages.back().bytes.clear();
  }
  return pages;
}

/// Writes the entry of a layer. Returns the bytes of the layer with its pages.
uint64_t writeEntry(ByteWriter& out, const LayerHead& head, const LayerSections& sections,
                    std::span<const Lengths> pages) {
  writeFields(out, head);
  if (hasFilter(head.kind, sections.size())) out.u8(head.filter);
  if (pages.empty()) {
    const Lengths lengths = lengthsOf(sections);
    out.append(lengths.bytes);
    return lengths.sections;
  }
  uint64_t sum = 0;
  for (const Lengths& page : pages) {
    out.varint(page.bytes.size());
    if (!page.bytes.empty()) out.varint(page.sections);
    sum += checksumBytes(page.bytes.size()) + page.bytes.size() + page.sections;
  }
  return sum;
}

void appendChecked(Bytes& out, const Bytes& bytes, uint32_t sum) {
  ByteWriter writer(out);
  if (checksumBytes(bytes.size()) == 2) writer.u16(sum);
  if (checksumBytes(bytes.size()) == 4) writer.u32(sum);
  writer.append(bytes);
}

}  // namespace

void append(Bytes& out, const Header& header, std::span<const LayerHead> heads,
            const std::vector<LayerSections>& layers) {
  std::vector<std::vector<Lengths>> pages;
  for (const LayerSections& sections : layers) pages.push_back(pagesOf(sections));
  Bytes index;
  ByteWriter entries(index);
  uint64_t bytes = 0;
  entries.u8(heads.size());
  for (std::size_t i = 0; i < heads.size(); ++i)
    bytes += writeEntry(entries, heads[i], layers[i], pages[i]);
  constexpr std::size_t kSum = 4;
  Header whole = header;
  whole.bytes = index.size() + kSum + bytes;
  const std::size_t start = out.size();
  ByteWriter writer(out);
  write(writer, whole);
  writer.append(index);
  Crc32 crc;
  crc.add(std::span<const std::byte>(out).subspan(start));
  const uint32_t identity = crc.sum();
  writer.u32(identity);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    for (std::size_t page = 0; page < pages[i].size(); ++page) {
      const Bytes& lengths = pages[i][page].bytes;
      appendChecked(out, lengths, pageChecksum(identity, i, page, lengths));
    }
    for (std::size_t chunk = 0; chunk < layers[i].size(); ++chunk)
      appendChecked(out, layers[i][chunk], checksum(identity, i, chunk, layers[i][chunk]));
  }
}

}  // namespace isostar
