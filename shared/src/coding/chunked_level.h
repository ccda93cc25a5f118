// A level in chunks.
#pragma once

#include "coding/chunk_state.h"
#include "coding/codec_state.h"
#include "util/cold_path.h"
#include "util/run_all.h"

namespace isostar {

/// The chunks of the level coded last, as far as they are decoded. Signs and geometry are joined in
/// the CodecState of the whole stream, which refers to the geometry that is kept here.
template <int D>
class ChunkedLevel {
 public:
  using Chunks = std::vector<std::unique_ptr<ChunkState<D>>>;

  [[nodiscard]] Chunks& chunks() { return chunks_; }

  /// The sign of a chunk of the level after the whole's last one, if the signs that it refines are
  /// all the same: its own are then the same, too, unless its section holds others.
  [[nodiscard]] ISOSTAR_COLD static std::optional<uint32_t> uniform(const CodecState<D>& whole,
                                                                    std::size_t number) {
    const auto chunk =
        ChunkGrid<D>(whole.signs.lattice().finer(), whole.header.chunkSide).chunk(number);
    const auto& table = whole.signs.table();
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      low[a] = chunk.origin[a] / 2;
      high[a] = std::min((chunk.end[a] + Chunk<D>::kHalo - 1) / 2, table.count(a) - 1);
    }
    const uint32_t slot = whole.signs.slot(table.index(low));
    bool same = slot <= Signs<D>::kPositive;
    forEachBetween<D>(low, high, [&](const Coordinates<D>& brick) {
      same = same && whole.signs.slot(table.index(brick)) == slot;
    });
    return same ? std::optional(slot) : std::nullopt;
  }
  /// A chunk of the level after the whole's last one, with no sign coded.
  [[nodiscard]] ISOSTAR_COLD static std::unique_ptr<ChunkState<D>> next(const CodecState<D>& whole,
                                                                        std::size_t number) {
    const Lattice<D> finer = whole.signs.lattice().finer();
    return std::make_unique<ChunkState<D>>(
        ChunkGrid<D>(finer, whole.header.chunkSide).chunk(number), whole.signs,
        BrickTable<D>(finer));
  }
  /// The signs of the level after the whole's last one, while its chunks are joined.
  struct Joined {
    Signs<D> signs;
    std::vector<uint8_t> has;   // by chunk: are its signs known?
    std::vector<uint8_t> here;  // by chunk: is it coded here?
  };
  /// `here`: by chunk. `isWhole`: all others will be joined, too; if not, they are shown as the
  /// level before. `chunks`: those that are here and not uniform().
  [[nodiscard]] ISOSTAR_COLD static Joined join(const CodecState<D>& whole,
                                                std::vector<uint8_t> here, bool isWhole,
                                                const Chunks& chunks) {
    Joined joined{isWhole ? Signs<D>(whole.signs.lattice().finer()) : refined(whole.signs), here,
                  std::move(here)};
    const ChunkGrid<D> grid(joined.signs.lattice(), whole.header.chunkSide);
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      if (chunks[i]) {
        chunks[i]->joinSigns(joined.signs);
      } else if (isWhole && joined.here[i] != 0 && uniform(whole, i) == Signs<D>::kPositive) {
        forEachBrickOf(grid.chunk(i), joined.signs.table(), [&](std::size_t brickIndex) {
          joined.signs.setUniform(brickIndex, Signs<D>::kPositive);
        });
      }
    }
    return joined;
  }
  /// Makes the next level the whole's last one. `chunks`: as of join().
  ISOSTAR_COLD void finishLevel(Joined joined, Chunks chunks, SmoothingFilter filter,
                                CodecState<D>& whole, const RunTasks& runTasks) {
    const bool several =
        std::ranges::any_of(chunks, [](const auto& chunk) { return chunk == nullptr; });
    const std::vector<uint8_t> here = std::move(joined.here);
    enterLevel(std::move(joined), filter, whole);
    ++whole.level;
    chunks_ = std::move(chunks);
    if (several)
      whole.active = activeBricks(whole.signs);
    else
      whole.active.assign(whole.signs.table().total(), 0);
    const ChunkGrid<D> grid(whole.signs.lattice(), whole.header.chunkSide);
    runAll(runTasks, chunks_.size(), [&](std::size_t i) {
      auto& chunk = chunks_[i];
      if (here[i] == 0) return;
      if (!chunk) {
        if (!isActive(grid.chunk(i), whole)) return;
        chunk = std::make_unique<ChunkState<D>>(grid.chunk(i), whole.signs);
      }
      chunk->beginGeometry(whole.signs);
      chunk->joinActive(whole.active);
      if (!chunk->hasGeometry()) chunk.reset();
    });
  }
  /// The same at the end of a stream: nothing more is coded.
  ISOSTAR_COLD static void enterLevel(Joined joined, SmoothingFilter filter, CodecState<D>& whole) {
    Signs<D>& signs = joined.signs;
    if (whole.coarser.empty() &&
        std::find(joined.has.begin(), joined.has.end(), 0) == joined.has.end())
      return whole.enterLevel(std::move(signs), filter);
    auto missing = activeBricks(signs);
    const ChunkGrid<D> grid(signs.lattice(), whole.header.chunkSide);
    for (std::size_t i = 0; i < joined.has.size(); ++i) {
      if (joined.has[i] != 0)
        forEachBrickOf(grid.chunk(i), signs.table(),
                       [&](std::size_t brickIndex) { missing[brickIndex] = 0; });
    }
    Signs<D> absent = RefinementCoder<D>::newVertices(signs, missing);
    if (!whole.coarser.empty()) {
      forEachMember(whole.coarser.absent(), [&](const Coordinates<D>& v) {
        absent.set(whole.signs.lattice().onFiner(v), true);
      });
    }
    whole.enterLevel(std::move(signs), filter, std::move(absent));
  }
  /// Shows the whole what a pass over all chunks has coded.
  ISOSTAR_COLD void finishPass(const GeometryPass<D>& pass, bool complete, CodecState<D>& whole) {
    whole.beginPass(pass);
    for (auto& chunk : chunks_) {
      if (chunk) chunk->joinGeometry(whole);
    }
    whole.endPass(pass, complete);
  }
  /// Bytes of some chunks of the level after the whole's last one, without what is coded in them.
  [[nodiscard]] ISOSTAR_COLD static uint64_t memoryOf(const CodecState<D>& whole,
                                                      std::size_t chunks) {
    // By brick: an index, a mark each of the halo and of activity, slots of signs, displacements
    // and scalars, a gradient; and of the coarser level while signs are refined.
    constexpr uint64_t kBytesPerBrick =
        sizeof(std::size_t) + 3 + 3 * (sizeof(uint32_t) + 1) + 2 + 16;
    const auto side =
        static_cast<uint64_t>(whole.header.chunkSide / kBrickSide + 2 * Chunk<D>::kHalo);
    uint64_t bricks = 1;
    for (int a = 0; a < D; ++a) bricks *= side;
    bricks = std::min<uint64_t>(bricks, BrickTable<D>(whole.signs.lattice().finer()).total());
    return chunks *
           (sizeof(ChunkState<D>) + MagnitudeCoder<D>::memoryOfModels() + bricks * kBytesPerBrick);
  }
  [[nodiscard]] ISOSTAR_COLD uint64_t memory() const {
    uint64_t sum = 0;
    for (const auto& chunk : chunks_) sum += chunk ? chunk->memory() : 0;
    return sum;
  }

 private:
  /// Does the surface touch the chunk?
  [[nodiscard]] static bool isActive(const Chunk<D>& chunk, const CodecState<D>& whole) {
    bool active = false;
    forEachBrickOf(chunk, whole.signs.table(), [&](std::size_t brickIndex) {
      active = active || whole.active[brickIndex] != 0;
    });
    return active;
  }

  Chunks chunks_;  // empty while the level is one chunk; null without a surface, or not coded here
};

}  // namespace isostar
