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
  chooseBytes();
  shown = offset = at = heads->start();
  shares.emplace(heads->header(), heads->indexed(), share);
  Limits left = limits;
  left.memory -= heads->memory();
  reconstruction = reconstructionOf(heads->header(), left, runTasks);
  if (!reconstruction) return fail(Error::UnsupportedVersion);
  if (shares->areSeveral()) reconstruction->beShare(share.number == 0);
  return true;
}

ISOSTAR_COLD void StreamDecoder::chooseBytes() {
  choice.emplace(heads->header(), region);
  const auto indexed = heads->indexed();
  if (indexed.empty()) {
    in.want({{heads->start(), heads->end()}}, heads->start());
    return;
  }
  in.want(choice->ranges(indexed, heads->start()), heads->start());
  wantedLayers = indexed.size();
  while (wantedLayers > 0 && !choice->hasAny(indexed[wantedLayers - 1])) --wantedLayers;
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

/// The head of the next layer that is wanted; `used`: its bytes before the layer.
ISOSTAR_COLD Error StreamDecoder::nextHead(LayerHead& head, std::size_t& used) {
  for (;;) {
    const Error e = heads->next(in.bytes(), at, info.layers.size(), head, used);
    if (e != Error::None || choice->hasAny(head)) return e;
    addLayer(info, heads->header(), head, used, static_cast<std::size_t>(offset));
    offset += head.bytes;
  }
}

ISOSTAR_COLD bool StreamDecoder::advance() {
  if (error != Error::None || tornShown || awaited != 0) return false;
  if (!heads && !readHeader()) return false;
  if (reconstruction->isOpen()) {
    const Error e = reconstruction->close();
    return e == Error::None ? finishLayer() : fail(e);
  }
  if (isFinal()) return false;
  const Error e = nextHead(inWork, headBytes);
  if (e != Error::None) return e == Error::Truncated && !finished ? false : fail(e);
  const auto rest = in.bytes().subspan(at + headBytes);
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
  at += headBytes + static_cast<std::size_t>(choice->bytes(inWork));
  addLayer(info, heads->header(), inWork, headBytes, static_cast<std::size_t>(offset + headBytes));
  shown = offset += headBytes + inWork.bytes;
  rms = inWork.error;
  return true;
}

}  // namespace isostar
