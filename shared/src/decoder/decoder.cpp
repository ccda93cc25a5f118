// The public decoder.
#include <cmath>

#include "decoder/stream_decoder.h"
#include "isostar/isostar.h"

namespace isostar {
namespace {

constexpr int kMostShares = 1 << 16;

}  // namespace

struct Decoder::State : StreamDecoder {
  using StreamDecoder::StreamDecoder;
};

Decoder::Decoder(const Limits& limits, RunTasks runTasks)
    : state_(std::make_unique<State>(limits, std::move(runTasks))) {}
Decoder::~Decoder() = default;
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;

Error Decoder::setRegion(const Region& region) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (!std::isfinite(region.least[a]) || !std::isfinite(region.most[a]) ||
        region.least[a] > region.most[a])
      return Error::BadArgument;
  }
  if (state_->accepted != 0) return Error::BadArgument;
  state_->region = region;
  return Error::None;
}
Error Decoder::setShare(const Share& share) {
  if (share.of < 1 || share.of > kMostShares || share.number < 0 || share.number >= share.of)
    return Error::BadArgument;
  if (state_->accepted != 0) return Error::BadArgument;
  state_->share = share;
  return Error::None;
}
bool Decoder::needsOthers() const {
  return state_->awaited != 0;
}
std::vector<std::byte> Decoder::results() const {
  std::vector<std::byte> out;
  if (state_->reconstruction) state_->reconstruction->results(out);
  return out;
}
bool Decoder::takeResults(std::span<const std::byte> bytes) {
  auto& reconstruction = state_->reconstruction;
  if (!reconstruction || reconstruction->isOpen() != needsOthers()) return false;
  if (!reconstruction->take(bytes)) return false;
  if (state_->awaited != 0) --state_->awaited;
  return true;
}
void Decoder::accept(std::span<const std::byte> bytes) {
  state_->accept(bytes, state_->accepted);
}
void Decoder::accept(std::span<const std::byte> bytes, uint64_t offset) {
  state_->accept(bytes, offset);
}
ByteRange Decoder::wanted(uint64_t from) const {
  const ByteRange next = state_->in.wanted(from);
  const bool isOver = state_->error != Error::None || state_->finished;
  return isOver ? ByteRange{next.begin, next.begin} : next;
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
Error Decoder::mesh(const MeshOptions& options, Mesh& out, std::vector<MeshRun>& runs) const {
  out = {};
  runs.clear();
  if (const Error error = state_->shows(options); error != Error::None) return error;
  if (state_->reconstruction->isDivided()) return state_->reconstruction->show(options, out, runs);
  if (state_->share.number != 0) return Error::None;
  const Error error = state_->reconstruction->show(options, out);
  runs.push_back({0, 0, static_cast<uint32_t>(out.positions.size() / 3),
                  static_cast<uint32_t>(out.indices.size())});
  return error;
}
Error Decoder::contours(const MeshOptions& options, Contours& out) const {
  out = {};
  const Error error = state_->shows(options);
  return error == Error::None ? state_->reconstruction->show(options, out) : error;
}

}  // namespace isostar
