#include "bench/chunks/chunk_bytes.h"

#include "bench/chunks/coded_layer.h"
#include "decoder/layer_input.h"
#include "files/failure.h"
#include "scalars/crossings.h"

namespace isostar::bench {
namespace {

[[noreturn]] void unfit(const char* why) {
  throw native::Failure("stream", why);
}

/// The header and layers of a sound stream, one after the other.
class LayerReader {
 public:
  explicit LayerReader(std::span<const std::byte> stream) : rest_(stream) {
    std::size_t used = 0;
    if (read(rest_, header_, used) != Error::None) unfit("is not isostar's");
    rest_ = rest_.subspan(used);
    if (header_.dimension != 3 || header_.adaptive || header_.keepsTopology || header_.trimmed ||
        !header_.furtherIsovalues.empty())
      unfit("is not a uniform one of a volume");
  }

  [[nodiscard]] const Header& header() const { return header_; }
  [[nodiscard]] bool next(LayerHead& head, LayerInput<3>& input) {
    if (rest_.empty()) return false;
    std::size_t used = 0;
    if (read(rest_, header_, head, used) != Error::None || head.bytes > rest_.size() - used ||
        input.read(head.kind, rest_.subspan(used, head.bytes), false))
      unfit("is damaged");
    rest_ = rest_.subspan(used + head.bytes);
    return true;
  }

 private:
  std::span<const std::byte> rest_;
  Header header_;
};

void decode(CodecState<3>& state, const LayerHead& head, const LayerInput<3>& input) {
  RangeDecoder coder(input.coded);
  DecoderExchange<3> exchange(coder, LayerInput<3>::kSlack, UINT64_MAX);
  state.code(exchange, head, input.pass);
}

class Chunking {
 public:
  Chunking(std::span<const std::byte> stream, const ChunkOptions& options)
      : options_(options), reader_(stream), whole_(reader_.header()) {}

  ChunkBytes run() {
    LayerHead head;
    LayerInput<3> input;
    while (reader_.next(head, input)) layer(head, input);
    for (const ChunkPart& chunk : chunks_) bytes_.differing += differing(chunk);
    return bytes_;
  }

 private:
  void layer(const LayerHead& head, const LayerInput<3>& input) {
    const Signs<3> signs = whole_.signs;
    const Scalars<3> scalars = whole_.scalars;
    const Displacements<3> displacements = whole_.displacements;
    decode(whole_, head, input);
    if (head.kind == LayerKind::Refinement) enterLevel(signs);
    if (chunks_.empty()) {
      bytes_.layers += head.bytes;
      ++bytes_.sections;
      coarse_ = std::make_unique<ChunkModels>(
          ChunkModels{whole_.refinement, whole_.displacing, whole_.exponents, whole_.magnitudes});
      return;
    }
    std::vector<std::byte> joint;
    RangeEncoder jointCoder(joint);
    for (ChunkPart& chunk : chunks_) {
      if (options_.seesScalars && head.kind != LayerKind::Refinement)
        fillHalo(chunk, scalars, displacements);
      const CodedLayer field(chunk, whole_, scalars, displacements, input.pass.displacement);
      if (!chunk.models) {
        code(jointCoder, chunk, *coarse_, field, head, input);
        continue;
      }
      std::vector<std::byte> section;
      RangeEncoder coder(section);
      code(coder, chunk, *chunk.models, field, head, input);
      coder.finish();
      add(section);
    }
    jointCoder.finish();
    add(joint);
  }

  /// `coarser`: the signs of the level before.
  void enterLevel(const Signs<3>& coarser) {
    const ChunkGrid<3> grid(whole_.signs.lattice(), options_.side);
    chunks_.clear();
    if (grid.total() == 1) return;
    for (std::size_t i = 0; i < grid.total(); ++i) {
      ChunkPart chunk(grid.chunk(i), whole_.signs, coarser);
      if (options_.models == ModelStart::Coarse)
        chunk.models = std::make_unique<ChunkModels>(*coarse_);
      if (options_.models == ModelStart::Initial) chunk.models = std::make_unique<ChunkModels>();
      chunks_.push_back(std::move(chunk));
    }
  }

  void code(RangeEncoder& coder, ChunkPart& chunk, ChunkModels& models, const CodedLayer& field,
            const LayerHead& head, const LayerInput<3>& input) const {
    EncoderExchange<3, RangeEncoder, CodedLayer> exchange(coder, chunk.actual, field);
    if (head.kind == LayerKind::Refinement)
      chunk.codeSigns(exchange, models);
    else
      chunk.codeGeometry(exchange, models, input.pass, whole_.filter, whole_.header.fitted);
  }

  void add(const std::vector<std::byte>& section) {
    bytes_.layers += section.size();
    bytes_.sections += section.empty() ? 0 : 1;
  }

  static void fillHalo(ChunkPart& chunk, const Scalars<3>& scalars,
                       const Displacements<3>& displacements) {
    for (std::size_t i = 0; i < chunk.indices.size(); ++i) {
      const std::size_t from = chunk.indices[i];
      if (chunk.halo[i] == 0 || from == BrickTable<3>::kNowhere) continue;
      if (scalars.tableSize() != 0 && scalars.has(from))
        chunk.scalars.writable(i) = scalars.at(from);
      if (displacements.tableSize() != 0 && displacements.has(from))
        chunk.displacements.writable(i) = displacements.at(from);
    }
  }

  [[nodiscard]] uint64_t differing(const ChunkPart& chunk) const {
    uint64_t count = 0;
    if (whole_.scalars.tableSize() == 0) return 0;
    for (std::size_t i = 0; i < chunk.indices.size(); ++i) {
      if (chunk.halo[i] != 0) continue;
      const auto& expected = whole_.scalars.at(chunk.indices[i]).value;
      const auto& found = chunk.scalars.at(i).value;
      for (std::size_t v = 0; v < expected.size(); ++v) count += expected[v] != found[v] ? 1 : 0;
    }
    return count;
  }

  const ChunkOptions options_;
  LayerReader reader_;
  CodecState<3> whole_;
  std::unique_ptr<ChunkModels>
      coarse_;  // of the last level of a single chunk; where models are shared, of all
  std::vector<ChunkPart> chunks_;  // of the current level; none if it is a single chunk
  ChunkBytes bytes_;
};

}  // namespace

ChunkBytes chunkBytes(std::span<const std::byte> stream, const ChunkOptions& options) {
  return Chunking(stream, options).run();
}

double sharedVertices(std::span<const std::byte> stream, int32_t side) {
  LayerReader reader(stream);
  CodecState<3> state(reader.header());
  LayerHead head;
  LayerInput<3> input;
  while (state.level < reader.header().finestLevel() && reader.next(head, input))
    decode(state, head, input);
  uint64_t all = 0, shared = 0;
  const auto isShared = [&](const Coordinates<3>& from, unsigned axes) {
    for (int a = 0; a < 3; ++a) {
      const bool between =
          from[a] % side == 0 && from[a] != 0 && from[a] != state.signs.lattice().last[a];
      if (between && (axes >> a & 1) == 0) return true;
    }
    return false;
  };
  forCrossedRows(
      state.signs, activeBricks(state.signs), false, [](std::size_t) {},
      [&](const Coordinates<3>& brick, unsigned r, unsigned axes, uint32_t crossed) {
        for (; crossed != 0; crossed &= crossed - 1, ++all) {
          const EdgeEnds<3> ends(brick, r, static_cast<unsigned>(std::countr_zero(crossed)), axes);
          shared += isShared(ends.even, axes) ? 1 : 0;
        }
      });
  return all == 0 ? 0 : static_cast<double>(shared) / static_cast<double>(all);
}

}  // namespace isostar::bench
