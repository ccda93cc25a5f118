// A level in chunks.
#pragma once

#include "coding/chunk_state.h"
#include "coding/codec_state.h"

namespace isostar {

/// The chunks of the level coded last. Signs and geometry are joined in the CodecState of the whole
/// stream, which refers to the geometry that is kept here.
template <int D>
class ChunkedLevel {
 public:
  using Chunks = std::vector<ChunkState<D>>;

  [[nodiscard]] bool empty() const { return chunks_.empty(); }
  [[nodiscard]] Chunks& chunks() { return chunks_; }

  /// The chunks of the level after the whole's last one, with no sign coded.
  [[nodiscard]] static Chunks next(const CodecState<D>& whole) {
    const Lattice<D> finer = whole.signs.lattice().finer();
    const BrickTable<D> table(finer);
    const ChunkGrid<D> grid(finer, whole.header.chunkSide);
    Chunks chunks;
    chunks.reserve(grid.total());
    for (std::size_t i = 0; i < grid.total(); ++i)
      chunks.emplace_back(grid.chunk(i), whole.signs, table);
    return chunks;
  }
  /// Makes a level whose signs are all coded the whole's last one.
  void finishLevel(Chunks chunks, SmoothingFilter filter, CodecState<D>& whole) {
    Signs<D> signs(whole.signs.lattice().finer());
    for (const auto& chunk : chunks) chunk.joinSigns(signs);
    whole.enterLevel(std::move(signs), filter);
    chunks_ = std::move(chunks);
    whole.active = activeBricks(whole.signs);
    for (auto& chunk : chunks_) chunk.beginGeometry(whole.signs);
  }
  /// Ends the stream within a level, of which the first `arrived` chunks are coded.
  static void keepUnfinished(const Chunks& chunks, std::size_t arrived, SmoothingFilter filter,
                             CodecState<D>& whole) {
    Signs<D> signs = refined(whole.signs);
    for (std::size_t i = 0; i < arrived; ++i) chunks[i].joinSigns(signs);
    auto missing = activeBricks(signs);
    for (std::size_t i = 0; i < arrived; ++i) chunks[i].clearOwn(missing);
    Signs<D> uncoded = RefinementCoder<D>::newVertices(signs, missing);
    whole.keepUnfinished(std::move(signs), std::move(uncoded), filter);
  }
  /// Shows the whole what a pass over all chunks has coded.
  void finishPass(const GeometryPass<D>& pass, bool complete, CodecState<D>& whole) {
    whole.beginPass(pass);
    for (auto& chunk : chunks_) chunk.joinGeometry(whole);
    whole.endPass(pass, complete);
  }
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = 0;
    for (const auto& chunk : chunks_) sum += chunk.memory();
    return sum;
  }

 private:
  Chunks chunks_;  // empty while the level is one chunk
};

}  // namespace isostar
