// A level in chunks.
#pragma once

#include "coding/chunk_state.h"
#include "coding/codec_state.h"
#include "util/cold_path.h"
#include "util/run_all.h"

namespace isostar {

/// The chunks of the level coded last. Signs and geometry are joined in the CodecState of the whole
/// stream, which refers to the geometry that is kept here.
template <int D>
class ChunkedLevel {
 public:
  using Chunks = std::vector<std::unique_ptr<ChunkState<D>>>;

  [[nodiscard]] Chunks& chunks() { return chunks_; }

  /// A chunk of the level after the whole's last one, with no sign coded.
  [[nodiscard]] ISOSTAR_COLD static std::unique_ptr<ChunkState<D>> next(const CodecState<D>& whole,
                                                                        std::size_t number) {
    const Lattice<D> finer = whole.signs.lattice().finer();
    return std::make_unique<ChunkState<D>>(
        ChunkGrid<D>(finer, whole.header.chunkSide).chunk(number), whole.signs,
        BrickTable<D>(finer));
  }
  /// Makes a level whose signs are all coded the whole's last one.
  ISOSTAR_COLD void finishLevel(Chunks chunks, SmoothingFilter filter, CodecState<D>& whole,
                                const RunTasks& runTasks) {
    Signs<D> signs(whole.signs.lattice().finer());
    for (const auto& chunk : chunks) chunk->joinSigns(signs);
    whole.enterLevel(std::move(signs), filter);
    chunks_ = std::move(chunks);
    whole.active.assign(whole.signs.table().total(), 0);
    runAll(runTasks, chunks_.size(), [&](std::size_t i) {
      chunks_[i]->beginGeometry(whole.signs);
      chunks_[i]->joinActive(whole.active);
    });
  }
  /// Ends the stream within a level, of which the first `arrived` chunks are coded.
  ISOSTAR_COLD static void keepUnfinished(const Chunks& chunks, std::size_t arrived,
                                          SmoothingFilter filter, CodecState<D>& whole) {
    Signs<D> signs = refined(whole.signs);
    for (std::size_t i = 0; i < arrived; ++i) chunks[i]->joinSigns(signs);
    auto missing = activeBricks(signs);
    for (std::size_t i = 0; i < arrived; ++i) chunks[i]->clearOwn(missing);
    Signs<D> uncoded = RefinementCoder<D>::newVertices(signs, missing);
    whole.keepUnfinished(std::move(signs), std::move(uncoded), filter);
  }
  /// Shows the whole what a pass over all chunks has coded.
  ISOSTAR_COLD void finishPass(const GeometryPass<D>& pass, bool complete, CodecState<D>& whole) {
    whole.beginPass(pass);
    for (auto& chunk : chunks_) chunk->joinGeometry(whole);
    whole.endPass(pass, complete);
  }
  /// Bytes of the chunks of the level after the whole's last one, without what is coded in them.
  [[nodiscard]] ISOSTAR_COLD static uint64_t memoryOf(const CodecState<D>& whole) {
    // By brick: an index, a mark each of the halo and of activity, slots of signs, displacements
    // and scalars, a gradient; and of the coarser level while signs are refined.
    constexpr uint64_t kBytesPerBrick = sizeof(std::size_t) + 3 + 3 * sizeof(uint32_t) + 16;
    const auto side =
        static_cast<uint64_t>(whole.header.chunkSide / kBrickSide + 2 * Chunk<D>::kHalo);
    uint64_t bricks = 1;
    for (int a = 0; a < D; ++a) bricks *= side;
    bricks = std::min<uint64_t>(bricks, BrickTable<D>(whole.signs.lattice().finer()).total());
    return whole.header.chunks(whole.level + 1) * (sizeof(ChunkState<D>) + bricks * kBytesPerBrick);
  }
  [[nodiscard]] ISOSTAR_COLD uint64_t memory() const {
    uint64_t sum = 0;
    for (const auto& chunk : chunks_) sum += chunk->memory();
    return sum;
  }

 private:
  Chunks chunks_;  // empty while the level is one chunk
};

}  // namespace isostar
