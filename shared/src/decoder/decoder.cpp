// The public decoder: collects bytes, splits them into layers and passes these to a Reconstruction.
#include <algorithm>
#include <optional>

#include "decoder/reconstruction.h"
#include "isostar/isostar.h"
#include "util/cold_path.h"

namespace isostar {
namespace {

StreamInfo describeHeader(const Header& h, std::size_t bytes) {
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
  info.maxError = h.lossless ? 0 : h.maxError;
  info.vertices = h.vertices;
  info.headerBytes = bytes;
  info.bytes = bytes + h.bytes;
  return info;
}

/// Adds a layer whose own bytes begin at `start`.
void addLayer(StreamInfo& info, const Header& header, const LayerHead& head, std::size_t headBytes,
              std::size_t start) {
  const bool further = traitsOf(head.kind).isFurther;
  info.headerBytes += headBytes;
  info.layers.push_back({traitsOf(head.kind).name, further ? header.finestLevel() : head.level,
                         start + head.bytes, head.bytes, head.error, further ? head.level : 0});
}

/// Reads the next layer's head. `arrived`: what has come of the rest of the stream; `left`: the
/// length of the whole rest. Corrupt if head and layer do not fit into the rest.
Error readHead(std::span<const std::byte> arrived, uint64_t left, const Header& header,
               LayerHead& head, std::size_t& used) {
  const Error error =
      read(arrived.first(std::min<uint64_t>(arrived.size(), left)), header, head, used);
  const bool whole = arrived.size() >= left;
  if (error == Error::Truncated && whole) return Error::Corrupt;
  return error == Error::None && head.bytes > left - used ? Error::Corrupt : error;
}

}  // namespace

Error inspect(std::span<const std::byte> stream, StreamInfo& out) {
  Header header;
  std::size_t at = 0;
  if (const Error error = read(stream, header, at); error != Error::None) return error;
  StreamInfo info = describeHeader(header, at);
  while (at < info.bytes && at < stream.size()) {
    LayerHead head;
    std::size_t used = 0;
    const Error error = readHead(stream.subspan(at), info.bytes - at, header, head, used);
    if (error == Error::Truncated) break;
    if (error != Error::None) return error;
    if (info.layers.size() == kMostLayers) return Error::Corrupt;
    at += used;
    addLayer(info, header, head, used, at);
    if (head.bytes > stream.size() - at) break;
    at += static_cast<std::size_t>(head.bytes);
  }
  out = std::move(info);
  return Error::None;
}

struct Decoder::State {
  explicit State(const Limits& l) : limits(l) {}

  void accept(std::span<const std::byte> bytes);
  bool advance();
  bool readHeader();
  bool decodeTorn(const LayerHead& head, std::span<const std::byte> bytes);
  bool fail(Error e) {
    if (error == Error::None) error = e;
    return false;
  }
  /// Can a surface be made with these options?
  [[nodiscard]] Error shows(const MeshOptions& options) const {
    if (!reconstruction) return Error::Truncated;
    return header->spans(options.isovalue.value_or(header->isovalue)) ? Error::None
                                                                      : Error::BadArgument;
  }
  [[nodiscard]] bool isFinal() const { return header && at == info.bytes; }

  Limits limits;
  std::vector<std::byte> in;
  std::size_t at = 0;  // the end of what has been decoded
  bool finished = false;
  Error error = Error::None;
  std::optional<Header> header;
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
  if (header) bytes = bytes.first(std::min<uint64_t>(bytes.size(), info.bytes - in.size()));
  if (bytes.size() > limits.memory - in.size())
    fail(Error::OverLimit);
  else
    in.insert(in.end(), bytes.begin(), bytes.end());
}

ISOSTAR_COLD bool Decoder::State::readHeader() {
  Header h;
  std::size_t used = 0;
  const Error e = read(in, h, used);
  if (e == Error::Truncated && !finished) return false;
  if (e != Error::None) return fail(e);
  uint64_t samples = 1;
  for (const int32_t n : h.size) {
    samples *= static_cast<uint64_t>(n);
    if (samples > limits.samples) return fail(Error::OverLimit);
  }
  if (h.vertices > limits.vertices) return fail(Error::OverLimit);
  header = h;
  info = describeHeader(h, used);
  in.resize(std::min<uint64_t>(in.size(), info.bytes));
  at = used;
  shown = used;
  reconstruction = reconstructionOf(*header, limits);
  return reconstruction != nullptr || fail(Error::UnsupportedVersion);
}

/// Decodes a layer whose last bytes are missing: the surface may be better for what is left.
bool Decoder::State::decodeTorn(const LayerHead& head, std::span<const std::byte> bytes) {
  tornShown = true;
  const auto [e, better] = reconstruction->decode(head, bytes, true);
  if (better) shown = in.size();
  fail(e == Error::None ? Error::Truncated : e);
  return better;
}

ISOSTAR_COLD bool Decoder::State::advance() {
  if (error != Error::None || tornShown) return false;
  if (!header && !readHeader()) return false;
  if (isFinal()) return false;
  LayerHead head;
  std::size_t used = 0;
  const std::span<const std::byte> rest = std::span<const std::byte>(in).subspan(at);
  const Error e = readHead(rest, info.bytes - at, *header, head, used);
  if (e != Error::None) return e == Error::Truncated && !finished ? false : fail(e);
  if (info.layers.size() == kMostLayers) return fail(Error::Corrupt);
  const auto bytes = rest.subspan(used);
  if (bytes.size() < head.bytes) return finished && decodeTorn(head, bytes);
  const auto layer = bytes.first(static_cast<std::size_t>(head.bytes));
  if (checksum(head, layer, info.layers.size()) != head.checksum) return fail(Error::Corrupt);
  if (const auto outcome = reconstruction->decode(head, layer, false); outcome.error != Error::None)
    return fail(outcome.error);
  at += used;
  addLayer(info, *header, head, used, at);
  at += static_cast<std::size_t>(head.bytes);
  shown = at;
  rms = head.error;
  return true;
}

Decoder::Decoder(const Limits& limits) : state_(std::make_unique<State>(limits)) {}
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
  return state_->header ? state_->header->finestLevel() + 1 : 0;
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
