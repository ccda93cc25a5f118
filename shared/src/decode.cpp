#include <algorithm>
#include <optional>

#include "completion.h"
#include "isostar/isostar.h"
#include "layers.h"
#include "polygonizer.h"

namespace isostar {
namespace {

const char* kindName(LayerKind kind) {
  switch (kind) {
    case LayerKind::Base: return "base";
    case LayerKind::Refinement: return "refinement";
    default: return "geometry";
  }
}

StreamInfo describeHeader(const Header& h, std::size_t bytes) {
  StreamInfo info;
  info.version = kFormatVersion;
  info.size = h.size;
  info.placement = h.placement;
  info.isovalues = {h.isovalue};
  info.polygonizer = h.polygonizer;
  info.lossless = h.lossless;
  info.maxError = h.lossless ? 0 : double{h.maxError};
  info.vertices = h.vertices;
  info.headerBytes = info.bytes = bytes;
  return info;
}

void addLayer(StreamInfo& info, const LayerHead& head, std::size_t headBytes) {
  info.headerBytes += headBytes;
  info.bytes += headBytes + head.bytes;
  info.layers.push_back({kindName(head.kind), head.level, info.bytes, head.bytes, head.error});
}

}  // namespace

Error inspect(std::span<const std::byte> stream, StreamInfo& out) {
  Header header;
  std::size_t at = 0;
  if (const Error error = read(stream, header, at); error != Error::None) return error;
  StreamInfo info = describeHeader(header, at);
  for (uint32_t i = 0; i < header.layers && at < stream.size(); ++i) {
    LayerHead head;
    std::size_t used = 0;
    const Error error = read(stream.subspan(at), header, head, used);
    if (error == Error::Truncated) break;
    if (error != Error::None) return error;
    addLayer(info, head, used);
    if (head.bytes > stream.size() - at - used) break;
    at += used + static_cast<std::size_t>(head.bytes);
  }
  out = std::move(info);
  return Error::None;
}

struct Decoder::State {
  explicit State(const Limits& l) : limits(l) {}

  bool advance();
  bool readHeader();
  bool decodeLayer(const LayerHead& head, std::span<const std::byte> bytes, bool torn);
  bool inOrder(LayerKind kind, int level) const;
  std::size_t memoryToRefine() const;
  bool fail(Error e) {
    if (error == Error::None) error = e;
    return false;
  }

  Limits limits;
  std::vector<std::byte> in;
  std::size_t at = 0;  // what has been decoded ends here
  bool finished = false;
  Error error = Error::None;
  std::optional<Header> header;
  StreamInfo info;
  uint32_t layers = 0;  // decoded whole
  bool tornShown = false;
  std::optional<Knowledge> known;
  bool based = false;
  uint64_t shown = 0;
  double rms = 0;
};

bool Decoder::State::readHeader() {
  Header h;
  std::size_t used = 0;
  const Error e = read(in, h, used);
  if (e == Error::Truncated && !finished) return false;
  if (e != Error::None) return fail(e);
  const uint64_t plane = static_cast<uint64_t>(h.size[0]) * static_cast<uint64_t>(h.size[1]);
  if (plane > limits.samples || plane * static_cast<uint64_t>(h.size[2]) > limits.samples || h.vertices > limits.vertices) return fail(Error::OverLimit);
  // The base octave is small by construction: a larger one would be a way to make us allocate.
  const auto base = h.base();
  for (int32_t last : base.last) {
    if (last > Header::kMostBaseCells) return fail(Error::Corrupt);
  }
  header = h;
  info = describeHeader(h, used);
  at = used;
  shown = used;
  known.emplace(h);
  return true;
}

/// The base first, then each octave, then geometry on the finest.
bool Decoder::State::inOrder(LayerKind kind, int level) const {
  if (!based) return kind == LayerKind::Base && level == 0;
  if (known->level < header->octaves) return kind == LayerKind::Refinement && level == known->level + 1;
  return (kind == LayerKind::Octaves || kind == LayerKind::Halving) && level == header->octaves;
}

/// What it takes at most to begin the next octave: both octaves' tables, a mark for each place, eight bricks for one.
std::size_t Decoder::State::memoryToRefine() const {
  const std::size_t places = BrickTable<3>(known->signs.lattice().finer()).total();
  return known->signs.memory() + places * (sizeof(uint32_t) + 1) + std::size_t{8} * known->signs.brickCount() * sizeof(Brick<3>);
}

bool Decoder::State::decodeLayer(const LayerHead& head, std::span<const std::byte> bytes, bool torn) {
  constexpr std::size_t kTrimmed = 8;  // four bytes that the encoder may leave out, four that the decoder reads ahead
  if (!inOrder(head.kind, head.level)) return fail(Error::Corrupt);
  GeometryPass pass;
  pass.kind = head.kind;
  const bool geometry = head.kind == LayerKind::Octaves || head.kind == LayerKind::Halving;
  if (torn && !geometry) return false;  // an octave shows only as a whole
  if (geometry) {
    ByteReader fields(bytes);
    if (!pass.read(fields)) return fail(Error::Corrupt);
    if (fields.overrun()) return torn ? false : fail(Error::Corrupt);
    bytes = bytes.subspan(fields.position());
  }
  if (head.kind == LayerKind::Refinement && memoryToRefine() > limits.memory) return fail(Error::OverLimit);
  const std::size_t settled = geometry ? known->signs.memory() : 0;
  RangeDecoder coder(bytes);
  BlindExchange<3> ask(coder, torn ? 0 : kTrimmed, limits.memory - std::min<std::size_t>(settled, limits.memory));
  if (geometry) {
    known->geometry(ask, pass);
  } else if (head.kind == LayerKind::Base) {
    known->base(ask);
    based = true;
  } else {
    known->refine(ask);
  }
  if (ask.overBudget()) return fail(Error::OverLimit);
  if (!torn && ask.spent()) return fail(Error::Corrupt);
  return true;
}

bool Decoder::State::advance() {
  if (error != Error::None || tornShown) return false;
  if (!header && !readHeader()) return false;
  if (layers == header->layers) return false;
  LayerHead head;
  std::size_t used = 0;
  const std::span<const std::byte> rest = std::span<const std::byte>(in).subspan(at);
  const Error e = read(rest, *header, head, used);
  if (e != Error::None) return e == Error::Truncated && !finished ? false : fail(e);
  const auto bytes = rest.subspan(used);
  if (bytes.size() < head.bytes) {
    if (!finished) return false;
    tornShown = true;
    const bool better = decodeLayer(head, bytes, true);
    if (better) shown = in.size();
    fail(Error::Truncated);
    return better;
  }
  const auto layer = bytes.first(static_cast<std::size_t>(head.bytes));
  if (checksum(layer) != head.checksum) return fail(Error::Corrupt);
  if (!decodeLayer(head, layer, false)) return false;
  addLayer(info, head, used);
  at += used + static_cast<std::size_t>(head.bytes);
  shown = at;
  rms = head.error;
  ++layers;
  return true;
}

Decoder::Decoder(const Limits& limits) : state_(std::make_unique<State>(limits)) {}
Decoder::~Decoder() = default;
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;

void Decoder::feed(std::span<const std::byte> bytes) { state_->in.insert(state_->in.end(), bytes.begin(), bytes.end()); }
void Decoder::finish() { state_->finished = true; }
bool Decoder::advance() { return state_->advance(); }
Error Decoder::error() const { return state_->error; }
bool Decoder::ready() const { return state_->header.has_value(); }
const StreamInfo& Decoder::info() const { return state_->info; }
int Decoder::level() const { return state_->based ? state_->known->level : -1; }
int Decoder::levels() const { return state_->header ? state_->header->octaves + 1 : 0; }
uint64_t Decoder::bytes() const { return state_->shown; }
double Decoder::rmsError() const { return state_->rms; }
bool Decoder::complete() const { return state_->header && state_->layers == state_->header->layers; }

Error Decoder::mesh(const MeshOptions& options, Mesh& out) const {
  out = {};
  if (!state_->header) return Error::Truncated;
  if (!state_->based) return Error::None;
  const Knowledge& known = *state_->known;
  const Header& header = *state_->header;
  const Surface surface{known.signs, known.scalars, 2 * header.positiveOffset - 1, 2 * header.negativeOffset - 1, header.placement};
  const bool diagonals = options.polygonizer == Polygonizer::Tetrahedra;
  if (!state_->tornShown && known.told[0] && (known.told[1] || !diagonals)) return polygonize(surface, options, state_->limits.vertices, out);
  const auto active = known.active.empty() ? activeBricks(known.signs) : known.active;
  Scalars<3> scalars = known.active.empty() ? Scalars<3>(active.size()) : known.scalars;
  const int finer = scalars.magnify();
  const double scale = 1 << finer;
  estimateMissing(known.signs, active, Members::AxisEnds, finer, scalars);
  if (diagonals) estimateMissing(known.signs, active, Members::DiagonalEnds, finer, scalars);
  return polygonize({known.signs, scalars, surface.positiveOffset * scale, surface.negativeOffset * scale, header.placement}, options,
                    state_->limits.vertices, out);
}

}  // namespace isostar
