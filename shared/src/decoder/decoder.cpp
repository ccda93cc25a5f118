// The public decoder: collects bytes, splits them into layers and passes these to a Reconstruction.
#include <algorithm>
#include <optional>

#include "decoder/reconstruction.h"
#include "decoder/stream_heads.h"
#include "isostar/isostar.h"
#include "util/cold_path.h"

namespace isostar {
namespace {

StreamInfo describeHeader(const StreamHeads& heads) {
  const Header& h = heads.header();
  StreamInfo info;
  info.version = h.version;
  info.dimension = h.dimension;
  std::copy_n(h.size.begin(), 3, info.size.begin());
  info.frames = h.size[3];
  info.placement = h.placement;
  info.isovalues = {h.isovalue};
  info.isovalues.insert(info.isovalues.end(), h.furtherIsovalues.begin(), h.furtherIsovalues.end());
  info.polygonizer = h.polygonizer;
  info.lossless = h.lossless;
  info.adaptive = h.adaptive;
  info.preservesTopology = h.keepsTopology;
  info.effort = h.fitted ? 2 : 1;
  info.trimmed = h.trimmed;
  info.chunkSide = h.chunkSide;
  info.maxError = h.lossless ? 0 : h.maxError;
  info.vertices = h.vertices;
  info.headerBytes = heads.start();
  info.bytes = heads.end();
  return info;
}

/// Adds a layer whose own bytes begin at `start`. `headBytes`: of its head, if it has one in front.
void addLayer(StreamInfo& info, const Header& header, const LayerHead& head, std::size_t headBytes,
              std::size_t start) {
  const bool further = traitsOf(head.kind).isFurther;
  info.headerBytes += headBytes;
  info.layers.push_back({traitsOf(head.kind).name, further ? header.finestLevel() : head.level,
                         start + head.bytes, head.bytes, head.error, further ? head.level : 0});
}

uint32_t storedChecksum(std::span<const std::byte> bytes, std::size_t length) {
  ByteReader reader(bytes);
  return length == 2 ? reader.u16() : reader.u32();
}

}  // namespace

Error inspect(std::span<const std::byte> stream, StreamInfo& out) {
  StreamHeads heads;
  if (const Error error = heads.begin(stream); error != Error::None) return error;
  std::size_t at = heads.start();
  StreamInfo info = describeHeader(heads);
  while (!heads.isEnd(at, info.layers.size()) &&
         (at < stream.size() || heads.header().chunkSide != 0)) {
    LayerHead head;
    std::size_t used = 0;
    const Error error = heads.next(stream, at, info.layers.size(), head, used);
    if (error == Error::Truncated) break;
    if (error != Error::None) return error;
    at += used;
    addLayer(info, heads.header(), head, used, at);
    if (heads.header().chunkSide == 0 && head.bytes > stream.size() - at) break;
    at += static_cast<std::size_t>(head.bytes);
  }
  out = std::move(info);
  return Error::None;
}

struct Decoder::State {
  State(const Limits& l, RunTasks run) : limits(l), runTasks(std::move(run)) {}

  void accept(std::span<const std::byte> bytes);
  bool advance();
  bool readHeader();
  bool findSections(const LayerHead& head, std::span<const std::byte> bytes);
  bool decodeTorn(const LayerHead& head, std::span<const std::byte> bytes);
  bool fail(Error e) {
    if (error == Error::None) error = e;
    return false;
  }
  /// Can a surface be made with these options?
  [[nodiscard]] Error shows(const MeshOptions& options) const {
    if (!reconstruction) return Error::Truncated;
    const Header& header = heads->header();
    return header.spans(options.isovalue.value_or(header.isovalue)) ? Error::None
                                                                    : Error::BadArgument;
  }
  [[nodiscard]] bool isFinal() const { return heads && heads->isEnd(at, info.layers.size()); }

  Limits limits;
  RunTasks runTasks;
  std::vector<std::byte> in;
  std::size_t at = 0;       // the end of what has been decoded
  std::size_t nextTry = 0;  // with fewer bytes than this the header is not read again
  std::vector<std::span<const std::byte>> sections;  // of the layer in work, as far as they arrived
  bool finished = false;
  Error error = Error::None;
  std::optional<StreamHeads> heads;  // once header and index have arrived
  StreamInfo info;
  bool tornShown = false;
  std::unique_ptr<Reconstruction> reconstruction;
  uint64_t shown = 0;
  double rms = 0;
};

/// Drops bytes that come after an error, after finish() or after the stream's end: they are never
/// read.
void Decoder::State::accept(std::span<const std::byte> bytes) {
  if (error != Error::None || finished) return;
  if (heads) bytes = bytes.first(std::min<uint64_t>(bytes.size(), info.bytes - in.size()));
  if (bytes.size() > limits.memory - in.size())
    fail(Error::OverLimit);
  else
    in.insert(in.end(), bytes.begin(), bytes.end());
}

ISOSTAR_COLD bool Decoder::State::readHeader() {
  if (in.size() < nextTry && !finished) return false;
  StreamHeads found;
  const Error e = found.begin(in);
  nextTry = in.size() + in.size() / 8 + 1;
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
  in.resize(std::min<uint64_t>(in.size(), info.bytes));
  at = heads->start();
  shown = at;
  reconstruction = reconstructionOf(heads->header(), limits, runTasks);
  return reconstruction != nullptr || fail(Error::UnsupportedVersion);
}

/// Finds the sections of a layer in its bytes, as far as these have arrived; the last one may be
/// incomplete. False if one that is complete is damaged.
ISOSTAR_COLD bool Decoder::State::findSections(const LayerHead& head,
                                               std::span<const std::byte> bytes) {
  sections.clear();
  const std::size_t layer = info.layers.size();
  if (head.sections.empty()) {
    sections.push_back(bytes);
    return bytes.size() < head.bytes || checksum(head, bytes, layer) == head.checksum;
  }
  for (std::size_t chunk = 0; chunk < head.sections.size(); ++chunk) {
    const std::size_t length = static_cast<std::size_t>(head.sections[chunk]),
                      sum = checksumBytes(length);
    if (bytes.size() < sum) break;
    const auto section = bytes.subspan(sum, std::min(length, bytes.size() - sum));
    sections.push_back(section);
    if (section.size() < length) break;
    if (length != 0 &&
        storedChecksum(bytes, sum) != checksum(heads->identity(), layer, chunk, section))
      return false;
    bytes = bytes.subspan(sum + length);
  }
  return true;
}

/// Decodes a layer whose last bytes are missing: the surface may be better for what is left.
ISOSTAR_COLD bool Decoder::State::decodeTorn(const LayerHead& head,
                                             std::span<const std::byte> bytes) {
  tornShown = true;
  if (!findSections(head, bytes)) return fail(Error::Corrupt);
  const auto [e, better] = reconstruction->decode(head, sections, true);
  if (better) shown = in.size();
  fail(e == Error::None ? Error::Truncated : e);
  return better;
}

ISOSTAR_COLD bool Decoder::State::advance() {
  if (error != Error::None || tornShown) return false;
  if (!heads && !readHeader()) return false;
  if (isFinal()) return false;
  LayerHead head;
  std::size_t used = 0;
  const Error e = heads->next(in, at, info.layers.size(), head, used);
  if (e != Error::None) return e == Error::Truncated && !finished ? false : fail(e);
  const auto rest = std::span<const std::byte>(in).subspan(at + used);
  if (rest.size() < head.bytes) return finished && decodeTorn(head, rest);
  if (!findSections(head, rest.first(static_cast<std::size_t>(head.bytes))))
    return fail(Error::Corrupt);
  if (const auto outcome = reconstruction->decode(head, sections, false);
      outcome.error != Error::None)
    return fail(outcome.error);
  at += used;
  addLayer(info, heads->header(), head, used, at);
  at += static_cast<std::size_t>(head.bytes);
  shown = at;
  rms = head.error;
  return true;
}

Decoder::Decoder(const Limits& limits, RunTasks runTasks)
    : state_(std::make_unique<State>(limits, std::move(runTasks))) {}
Decoder::~Decoder() = default;
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;

void Decoder::accept(std::span<const std::byte> bytes) {
  state_->accept(bytes);
}
void Decoder::finish() {
  state_->finished = true;
}
bool Decoder::advance() {
  return state_->advance();
}
Error Decoder::error() const {
  return state_->error;
}
bool Decoder::ready() const {
  return state_->reconstruction != nullptr;
}
const StreamInfo& Decoder::info() const {
  return state_->info;
}
int Decoder::level() const {
  return state_->reconstruction ? state_->reconstruction->level() : -1;
}
int Decoder::levels() const {
  return state_->heads ? state_->heads->header().finestLevel() + 1 : 0;
}
uint64_t Decoder::bytes() const {
  return state_->shown;
}
double Decoder::rmsError() const {
  return state_->rms;
}
bool Decoder::isFinal() const {
  return state_->isFinal();
}

Error Decoder::mesh(const MeshOptions& options, Mesh& out) const {
  out = {};
  const Error error = state_->shows(options);
  return error == Error::None ? state_->reconstruction->show(options, out) : error;
}
Error Decoder::contours(const MeshOptions& options, Contours& out) const {
  out = {};
  const Error error = state_->shows(options);
  return error == Error::None ? state_->reconstruction->show(options, out) : error;
}

}  // namespace isostar
