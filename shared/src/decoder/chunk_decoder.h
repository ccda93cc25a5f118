// Decodes the sections of a layer in chunks, which may run side by side.
#pragma once

#include <algorithm>
#include <optional>

#include "coding/chunked_level.h"
#include "decoder/layer_input.h"
#include "decoder/reconstruction.h"
#include "decoder/shared_level.h"
#include "util/cold_path.h"
#include "util/run_all.h"

namespace isostar {

template <int D>
class ChunkDecoder {
 public:
  using Outcome = Reconstruction::Outcome;

  /// What is left to spend, before a layer and after it.
  struct Budget {
    uint64_t memory, decisions;
  };

  explicit ChunkDecoder(const RunTasks& runTasks) : runTasks_(runTasks) {}

  [[nodiscard]] uint64_t memory() const {
    return level_.memory() + (share_ ? share_->memory() : 0) + (open_ ? open_->memory() : 0);
  }
  /// Sections from now on are those of a share.
  void beShare(bool isFirst) {
    isShare_ = true;
    isFirstShare_ = isFirst;
  }
  /// The last complete level, if it is divided among shares.
  [[nodiscard]] const std::optional<SharedLevel<D>>& share() const { return share_; }
  /// Does the next level wait for the signs of others?
  [[nodiscard]] bool isOpen() const { return open_.has_value(); }
  /// Ends it.
  ISOSTAR_COLD Error close(CodecState<D>& whole) {
    const Error error = open_->close(whole, level_, runTasks_);
    if (error == Error::None) share_ = std::move(open_);
    open_.reset();
    return error;
  }
  /// As of Reconstruction.
  ISOSTAR_COLD void results(const CodecState<D>& whole, std::vector<std::byte>& out) const {
    if (open_ || share_) (open_ ? open_ : share_)->results(whole, out);
  }
  [[nodiscard]] ISOSTAR_COLD bool take(std::span<const std::byte> bytes, CodecState<D>& whole) {
    return (open_ || share_) && (open_ ? open_ : share_)->take(bytes, whole);
  }

  /// Decodes a refinement or a pass. Of a layer that is `torn` what has arrived is decoded; chunks
  /// of a level that have not arrived, or are not wanted, are shown as the level before.
  Outcome decode(const LayerHead& head, Reconstruction::Sections sections, bool torn,
                 CodecState<D>& whole, Budget& budget) {
    const uint64_t lists = kBytesOfLists * head.sections.size(),
                   walks = kDecisionsPerChunk * head.sections.size();
    if (lists > budget.memory || walks > budget.decisions) return {Error::OverLimit};
    budget.memory -= lists;
    budget.decisions -= walks;
    return head.kind == LayerKind::Refinement ? refine(head, sections, torn, whole, budget)
                                              : pass(head, sections, torn, whole, budget);
  }

 private:
  /// What it costs to pass by a chunk, even an empty one, as Limits::decisions count it.
  static constexpr uint64_t kDecisionsPerChunk = 16;
  /// So many chunks share what is left: no order of work may spend more.
  static constexpr std::size_t kTogether = 16;

  /// A section's result.
  struct Piece {
    Error error = Error::None;
    uint64_t work = 0, memory = 0;  // memory: what is kept, beside what was counted before
  };
  /// For each section in lists, while a layer is decoded: of sections, of what is read of them, and
  /// of chunks.
  static constexpr uint64_t kBytesOfLists = 2 * sizeof(Reconstruction::Section) +
                                            sizeof(std::optional<LayerInput<D>>) + sizeof(Piece) +
                                            sizeof(std::unique_ptr<ChunkState<D>>) + 3;

  ISOSTAR_COLD Outcome refine(const LayerHead& head, Reconstruction::Sections sections, bool torn,
                              CodecState<D>& whole, Budget& budget) {
    // By chunk: is it decoded here, and is there anything to decode, here or elsewhere? Of a torn
    // level the last chunks have no sections.
    std::vector<uint8_t> here(head.sections.size()), made(head.sections.size());
    bool isWhole = sections.size() == head.sections.size();
    for (std::size_t i = 0; i < sections.size(); ++i) {
      // Only whole chunks count.
      const bool wanted = sections[i].isWanted && !isTorn(head, sections, i);
      isWhole = isWhole && wanted;
      here[i] = wanted && sections[i].isOwn ? 1 : 0;
      made[i] =
          wanted && (!sections[i].bytes.empty() || !ChunkedLevel<D>::uniform(whole, i)) ? 1 : 0;
    }
    if (torn && (isShare_ || std::find(here.begin(), here.end(), 1) == here.end())) return {};
    const uint64_t needed =
        memoryToRefine(whole, countBeside(made, whole.signs.lattice().finer(), whole.header));
    if (needed > budget.memory) return {Error::OverLimit};
    budget.memory -= needed;
    const uint64_t tables = ChunkedLevel<D>::memoryOf(whole, 1);
    typename ChunkedLevel<D>::Chunks chunks(head.sections.size());
    const Error error = run(sections, budget, [&](std::size_t i, const Budget& most) {
      if (here[i] == 0 || made[i] == 0) return Piece{};
      chunks[i] = ChunkedLevel<D>::next(whole, i);
      if (sections[i].bytes.empty()) return emptySection(chunks[i]->hasSigns());
      RefinementCoder<D> coder = whole.refinement;
      Piece piece = section(sections[i].bytes, most, false,
                            [&](auto& exchange) { chunks[i]->codeSigns(exchange, coder); });
      piece.memory = chunks[i]->memory() - std::min(chunks[i]->memory(), tables);
      return piece;
    });
    if (error != Error::None) return {error};
    const auto filter = static_cast<SmoothingFilter>(head.filter);
    auto joined = ChunkedLevel<D>::join(whole, std::move(here), isWhole, chunks);
    if (isShare_) {
      std::vector<uint8_t> expected;
      for (const auto& section : sections)
        expected.push_back(section.isWanted && !section.isOwn ? 1 : 0);
      open_.emplace(std::move(joined), std::move(chunks), std::move(expected), filter,
                    isFirstShare_);
    } else if (torn) {
      ChunkedLevel<D>::enterLevel(std::move(joined), filter, whole);
    } else {
      level_.finishLevel(std::move(joined), std::move(chunks), filter, whole, runTasks_);
    }
    return {Error::None, true};
  }

  ISOSTAR_COLD Outcome pass(const LayerHead& head, Reconstruction::Sections sections, bool torn,
                            CodecState<D>& whole, Budget& budget) {
    std::vector<std::optional<LayerInput<D>>> inputs(sections.size());
    std::optional<GeometryPass<D>> coded;
    for (std::size_t i = 0; i < sections.size(); ++i) {
      if (!sections[i].isWanted || sections[i].bytes.empty()) continue;
      LayerInput<D> input;
      if (const auto outcome =
              input.read(head.kind, sections[i].bytes, isTorn(head, sections, i))) {
        if (outcome->error != Error::None) return *outcome;
        continue;
      }
      coded = input.pass;
      inputs[i] = input;
    }
    auto& chunks = level_.chunks();
    const Error error = run(sections, budget, [&](std::size_t i, const Budget& most) {
      if (!sections[i].isOwn) return Piece{};
      if (sections[i].isWanted && sections[i].bytes.empty())
        return emptySection(chunks[i] && !isTorn(head, sections, i));
      if (!inputs[i]) return Piece{};
      if (!chunks[i]) return Piece{Error::Corrupt};
      const uint64_t before = chunks[i]->memory();
      Piece piece = section(inputs[i]->coded, most, isTorn(head, sections, i), [&](auto& exchange) {
        chunks[i]->codePass(exchange, inputs[i]->pass, whole.filter, whole.header.fitted);
      });
      piece.memory = chunks[i]->memory() - before;
      return piece;
    });
    uint64_t joined = 0;
    for (const auto& chunk : chunks) joined += chunk ? chunk->memoryToJoin() : 0;
    if (joined > budget.memory) return {Error::OverLimit};
    if (coded) level_.finishPass(*coded, !torn, whole);
    return {error, error == Error::None};
  }

  /// How many chunks of a level are marked, or lie beside one that is: no others can have a
  /// surface.
  [[nodiscard]] ISOSTAR_COLD static std::size_t countBeside(const std::vector<uint8_t>& marks,
                                                            const Lattice<D>& level,
                                                            const Header& header) {
    const ChunkGrid<D> grid(level, header.chunkSide);
    std::size_t count = 0;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      bool beside = false;
      grid.forEachAround(i, [&](std::size_t other) { beside = beside || marks[other] != 0; });
      count += beside ? 1 : 0;
    }
    return count;
  }

  /// Only a chunk without a surface has none.
  [[nodiscard]] static Piece emptySection(bool needed) {
    return {needed ? Error::Corrupt : Error::None, 0};
  }
  [[nodiscard]] static bool isTorn(const LayerHead& head, Reconstruction::Sections sections,
                                   std::size_t chunk) {
    return sections[chunk].isWanted && sections[chunk].bytes.size() < head.sections[chunk];
  }

  /// Decodes one section within a part of the budget.
  template <class Code>
  [[nodiscard]] static Piece section(std::span<const std::byte> bytes, const Budget& most,
                                     bool torn, Code code) {
    RangeDecoder coder(bytes);
    DecoderExchange<D> exchange(coder, torn ? 0 : LayerInput<D>::kSlack, most.memory,
                                most.decisions);
    code(exchange);
    return {exchange.overBudget()           ? Error::OverLimit
            : !torn && exchange.exhausted() ? Error::Corrupt
                                            : Error::None,
            exchange.work()};
  }

  /// Calls decodeChunk(number, budget) for each chunk that has arrived, long sections first,
  /// so that threads end at about the same time. The first error in the chunks' order counts: it
  /// does not depend on the order of work.
  template <class DecodeChunk>
  ISOSTAR_COLD Error run(Reconstruction::Sections sections, Budget& budget,
                         DecodeChunk decodeChunk) {
    const std::size_t count = sections.size();
    std::vector<Piece> pieces(count);
    std::array<std::size_t, kTogether> order;
    for (std::size_t first = 0; first < count; first += kTogether) {
      const std::size_t together = std::min(kTogether, count - first);
      for (std::size_t i = 0; i < together; ++i) {
        std::size_t at = i;
        const std::size_t length = sections[first + i].bytes.size();
        for (; at > 0 && sections[order[at - 1]].bytes.size() < length; --at)
          order[at] = order[at - 1];
        order[at] = first + i;
      }
      const Budget most{budget.memory / kTogether, budget.decisions / kTogether};
      runAll(runTasks_, together,
             [&](std::size_t i) { pieces[order[i]] = decodeChunk(order[i], most); });
      for (std::size_t i = first; i < first + together; ++i) {
        budget.decisions -= std::min(pieces[i].work, budget.decisions);
        budget.memory -= std::min(pieces[i].memory, budget.memory);
        if (pieces[i].error != Error::None) return pieces[i].error;
      }
    }
    return Error::None;
  }

  [[nodiscard]] static uint64_t memoryToRefine(const CodecState<D>& whole, std::size_t chunks) {
    // Signs in chunks with their halo, and joined.
    return 3 * whole.memoryToRefine() + ChunkedLevel<D>::memoryOf(whole, chunks);
  }

  const RunTasks& runTasks_;
  ChunkedLevel<D> level_;
  bool isShare_ = false, isFirstShare_ = false;
  std::optional<SharedLevel<D>> share_, open_;
};

}  // namespace isostar
