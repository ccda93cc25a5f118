// From bytes to layers, one after the other.
#include "decoder/stream_decoder.h"

#include <algorithm>

#include "decoder/stream_description.h"
#include "util/cold_path.h"

namespace isostar {
namespace {

uint32_t storedChecksum(std::span<const std::byte> bytes, std::size_t length) {
  ByteReader reader(bytes);
  return length == 2 ? reader.u16() : reader.u32();
}

}  // namespace

/// Drops bytes that come after an error, after finish() or after the stream's end: they are never
/// read.
void StreamDecoder::accept(std::span<const std::byte> bytes, uint64_t from) {
  accepted = from + bytes.size();
  if (error != Error::None || finished) return;
  if (!in.accept(bytes, from, limits.memory)) fail(Error::OverLimit);
  if (error == Error::None && !heads) readHeader();
  if (wants.isOpen && in.bytes().size() >= wants.at + wants.pages) chooseBytes();
}

ISOSTAR_COLD bool StreamDecoder::readHeader() {
  const std::size_t arrived = in.bytes().size();
  if (arrived < nextTry && !finished) return false;
  StreamHeads found;
  const Error e = found.begin(in.bytes(), limits.memory);
  nextTry = arrived + arrived / 8 + 1;
  if (e == Error::Truncated && !finished) return false;
  if (e != Error::None) return fail(e);
  uint64_t samples = 1;
  for (const int32_t n : found.header().size) {
    samples *= static_cast<uint64_t>(n);
    if (samples > limits.samples) return fail(Error::OverLimit);
  }
  if (found.header().vertices > limits.vertices) return fail(Error::OverLimit);
  heads = std::move(found);
  info = describeHeader(*heads);
  shown = offset = at = heads->start();
  chooseLayers();
  shares.emplace(heads->header(), heads->indexed(), share);
  Limits left = limits;
  left.memory -= heads->memory();
  reconstruction = reconstructionOf(heads->header(), left, runTasks);
  if (!reconstruction) return fail(Error::UnsupportedVersion);
  if (shares->areSeveral()) reconstruction->beShare(share.number == 0);
  return true;
}

ISOSTAR_COLD void StreamDecoder::chooseLayers() {
  choice.emplace(heads->header(), region);
  const auto indexed = heads->indexed();
  if (indexed.empty()) {
    in.want({{offset, heads->end()}}, false, at);
    return;
  }
  wants.start = offset;
  wants.at = at;
  chooseBytes();
  wantedLayers = indexed.size();
  while (wantedLayers > 0 && !choice->hasAny(indexed[wantedLayers - 1])) --wantedLayers;
}

/// Wants bytes of all layers up to the next pages that have not arrived.
ISOSTAR_COLD void StreamDecoder::chooseBytes() {
  const auto indexed = heads->indexed();
  std::vector<ByteRange> ranges;
  const auto add = [&](const LayerHead& head) {
    if (!choice->addRanges(head, wants.start, ranges)) return false;
    wants.start += pageBytes(head) + head.bytes;
    ++wants.layer;
    return true;
  };
  do {
    ranges.clear();
    if (wants.isOpen) {
      // If they are damaged, that is found when their layer is decoded.
      LayerHead head = indexed[wants.layer];
      if (readPages(head, wants.layer, wants.at) != Error::None) return;
      wants.at += wants.pages;
      add(head);
    }
    const std::size_t first = wants.at;
    while (wants.layer < indexed.size() && add(indexed[wants.layer])) {
    }
    for (const ByteRange& range : ranges)
      wants.at += static_cast<std::size_t>(range.end - range.begin);
    wants.isOpen = wants.layer < indexed.size();
    wants.pages = 0;
    if (wants.isOpen)
      wants.pages = static_cast<std::size_t>(choice->bytesOfPages(indexed[wants.layer]));
    wants.at -= wants.pages;
    in.want(ranges, wants.isOpen, first);
  } while (wants.isOpen);
}

/// Finds the sections of a layer in its bytes, as far as these have arrived; the last one may be
/// incomplete. False if one that is complete is damaged.
ISOSTAR_COLD bool StreamDecoder::findSections(const LayerHead& head,
                                              std::span<const std::byte> bytes) {
  sections.clear();
  const std::size_t layer = info.layers.size();
  if (head.sections.empty()) {
    sections.push_back({bytes});
    return bytes.size() < head.bytes || checksum(head, bytes, layer) == head.checksum;
  }
  for (std::size_t chunk = 0; chunk < head.sections.size(); ++chunk) {
    if (!choice->has(head, chunk)) {
      sections.push_back({{}, false});
      continue;
    }
    const std::size_t length = static_cast<std::size_t>(head.sections[chunk]),
                      sum = checksumBytes(length);
    if (bytes.size() < sum) break;
    const auto section = bytes.subspan(sum, std::min(length, bytes.size() - sum));
    const bool isOwn = shares->owns(head, chunk);
    sections.push_back({section, true, isOwn});
    if (section.size() < length) break;
    if (length != 0 && isOwn &&
        storedChecksum(bytes, sum) != checksum(heads->identity(), layer, chunk, section))
      return false;
    bytes = bytes.subspan(sum + length);
  }
  return true;
}

/// Decodes a layer whose last bytes are missing: the surface may be better for what is left.
ISOSTAR_COLD bool StreamDecoder::decodeTorn(const LayerHead& head,
                                            std::span<const std::byte> bytes) {
  tornShown = true;
  if (!findSections(head, bytes)) return fail(Error::Corrupt);
  const auto [e, better] = reconstruction->decode(head, sections, true);
  if (better) shown = in.end();
  fail(e == Error::None ? Error::Truncated : e);
  return better;
}

/// Finds the head of the next layer that is wanted.
ISOSTAR_COLD Error StreamDecoder::nextHead() {
  for (;;) {
    const Error e = heads->next(in.bytes(), at, info.layers.size(), inWork, headBytes);
    if (e != Error::None || choice->hasAny(inWork)) return e;
    offset += headBytes;
    addLayer(info, heads->header(), inWork, headBytes, static_cast<std::size_t>(offset));
    offset += inWork.bytes;
  }
}

/// Reads the wanted pages of a layer that begin at `from` in the bytes that have arrived.
/// Truncated: they have not all arrived.
ISOSTAR_COLD Error StreamDecoder::readPages(LayerHead& head, std::size_t layer,
                                            std::size_t from) const {
  head.sections.resize(static_cast<std::size_t>(heads->header().chunks(head.level)));
  auto bytes = in.bytes().subspan(from);
  for (std::size_t page = 0; page < head.pages.size(); ++page) {
    if (!choice->hasPage(head, page)) continue;
    const auto length = static_cast<std::size_t>(wholeBytes(head.pages[page]));
    if (bytes.size() < length) return Error::Truncated;
    const Error e = readPage(bytes.first(length), heads->identity(), layer, page, head);
    if (e != Error::None) return e;
    bytes = bytes.subspan(length);
  }
  return Error::None;
}

/// Reads the head of the next layer that is wanted, and its pages. False if that needs more bytes,
/// or on an error.
ISOSTAR_COLD bool StreamDecoder::readHead() {
  Error e = nextHead();
  headWanted = headBytes;
  if (e == Error::None && !inWork.pages.empty()) {
    headWanted = static_cast<std::size_t>(choice->bytesOfPages(inWork));
    e = in.bytes().size() - at < headWanted ? Error::Truncated
                                            : readPages(inWork, info.layers.size(), at);
    if (e == Error::None) shares->divide(inWork);
  }
  isHeadRead = e == Error::None;
  if (!isHeadRead && (e != Error::Truncated || finished)) fail(e);
  return isHeadRead;
}

ISOSTAR_COLD bool StreamDecoder::advance() {
  if (error != Error::None || tornShown || awaited != 0) return false;
  if (!heads && !readHeader()) return false;
  if (reconstruction->isOpen()) {
    const Error e = reconstruction->close();
    return e == Error::None ? finishLayer() : fail(e);
  }
  if (isFinal()) return false;
  if (!isHeadRead && !readHead()) return false;
  const auto rest = in.bytes().subspan(at + headWanted);
  const uint64_t length = choice->bytes(inWork);
  if (rest.size() < length) return finished && decodeTorn(inWork, rest);
  if (!findSections(inWork, rest.first(static_cast<std::size_t>(length))))
    return fail(Error::Corrupt);
  if (const auto outcome = reconstruction->decode(inWork, sections, false);
      outcome.error != Error::None)
    return fail(outcome.error);
  if (reconstruction->isOpen()) awaited = share.of - 1;
  return awaited == 0 && finishLayer();
}

/// Goes on behind a layer that is decoded.
bool StreamDecoder::finishLayer() {
  isHeadRead = false;
  at += headWanted + static_cast<std::size_t>(choice->bytes(inWork));
  addLayer(info, heads->header(), inWork, headBytes, static_cast<std::size_t>(offset + headBytes));
  shown = offset += headBytes + inWork.bytes;
  rms = inWork.error;
  return true;
}

}  // namespace isostar
