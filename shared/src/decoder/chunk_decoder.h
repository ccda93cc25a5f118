// Decodes the sections of a layer in chunks, which may run side by side.
#pragma once

#include <algorithm>
#include <optional>

#include "coding/chunked_level.h"
#include "decoder/layer_input.h"
#include "decoder/reconstruction.h"
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

  [[nodiscard]] uint64_t memory() const { return level_.memory(); }

  /// Decodes a refinement or a pass. Of a layer that is `torn` what has arrived is decoded; chunks
  /// of a level that have not arrived are shown as the level before.
  Outcome decode(const LayerHead& head, Reconstruction::Sections sections, bool torn,
                 CodecState<D>& whole, Budget& budget) {
    return head.kind == LayerKind::Refinement ? refine(head, sections, torn, whole, budget)
                                              : pass(head, sections, torn, whole, budget);
  }

 private:
  /// So many chunks share what is left: no order of work may spend more.
  static constexpr std::size_t kTogether = 16;

  /// A section's result.
  struct Piece {
    Error error = Error::None;
    uint64_t work = 0;
  };

  ISOSTAR_COLD Outcome refine(const LayerHead& head, Reconstruction::Sections sections, bool torn,
                              CodecState<D>& whole, Budget& budget) {
    // Of a torn level only whole chunks count.
    const std::size_t arrived =
        sections.size() -
        (!sections.empty() && isTorn(head, sections, sections.size() - 1) ? 1 : 0);
    if (torn && arrived == 0) return {};
    const uint64_t needed = memoryToRefine(whole);
    if (needed > budget.memory) return {Error::OverLimit};
    budget.memory -= needed;
    typename ChunkedLevel<D>::Chunks chunks(head.sections.size());
    const Error error = run(sections, arrived, budget, [&](std::size_t i, const Budget& most) {
      chunks[i] = ChunkedLevel<D>::next(whole, i);
      if (sections[i].empty()) return emptySection(chunks[i]->hasSigns());
      RefinementCoder<D> coder = whole.refinement;
      return section(sections[i], most, false,
                     [&](auto& exchange) { chunks[i]->codeSigns(exchange, coder); });
    });
    if (error != Error::None) return {error};
    const auto filter = static_cast<SmoothingFilter>(head.filter);
    if (torn)
      ChunkedLevel<D>::keepUnfinished(chunks, arrived, filter, whole);
    else
      level_.finishLevel(std::move(chunks), filter, whole, runTasks_);
    return {Error::None, true};
  }

  ISOSTAR_COLD Outcome pass(const LayerHead& head, Reconstruction::Sections sections, bool torn,
                            CodecState<D>& whole, Budget& budget) {
    std::vector<std::optional<LayerInput<D>>> inputs(sections.size());
    std::optional<GeometryPass<D>> coded;
    for (std::size_t i = 0; i < sections.size(); ++i) {
      if (sections[i].empty()) continue;
      LayerInput<D> input;
      if (const auto outcome = input.read(head.kind, sections[i], isTorn(head, sections, i))) {
        if (outcome->error != Error::None) return *outcome;
        continue;
      }
      coded = input.pass;
      inputs[i] = input;
    }
    auto& chunks = level_.chunks();
    const Error error =
        run(sections, sections.size(), budget, [&](std::size_t i, const Budget& most) {
          if (sections[i].empty())
            return emptySection(chunks[i]->hasGeometry() && !isTorn(head, sections, i));
          if (!inputs[i]) return Piece{};
          return section(inputs[i]->coded, most, isTorn(head, sections, i), [&](auto& exchange) {
            chunks[i]->codePass(exchange, inputs[i]->pass, whole.filter, whole.header.fitted);
          });
        });
    if (coded) level_.finishPass(*coded, !torn, whole);
    return {error, error == Error::None};
  }

  /// Only a chunk without a surface has none.
  [[nodiscard]] static Piece emptySection(bool needed) {
    return {needed ? Error::Corrupt : Error::None, 0};
  }
  [[nodiscard]] static bool isTorn(const LayerHead& head, Reconstruction::Sections sections,
                                   std::size_t chunk) {
    return sections[chunk].size() < head.sections[chunk];
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

  /// Calls decodeChunk(number, budget) for each of the first `count` chunks, long sections first,
  /// so that threads end at about the same time. The first error in the chunks' order counts: it
  /// does not depend on the order of work.
  template <class DecodeChunk>
  Error run(Reconstruction::Sections sections, std::size_t count, Budget& budget,
            DecodeChunk decodeChunk) {
    std::vector<Piece> pieces(count);
    std::array<std::size_t, kTogether> order;
    for (std::size_t first = 0; first < count; first += kTogether) {
      const std::size_t together = std::min(kTogether, count - first);
      for (std::size_t i = 0; i < together; ++i) {
        std::size_t at = i;
        for (; at > 0 && sections[order[at - 1]].size() < sections[first + i].size(); --at)
          order[at] = order[at - 1];
        order[at] = first + i;
      }
      const Budget most{budget.memory / kTogether, budget.decisions / kTogether};
      runAll(runTasks_, together,
             [&](std::size_t i) { pieces[order[i]] = decodeChunk(order[i], most); });
      for (std::size_t i = first; i < first + together; ++i) {
        budget.decisions -= std::min(pieces[i].work, budget.decisions);
        if (pieces[i].error != Error::None) return pieces[i].error;
      }
    }
    return Error::None;
  }

  [[nodiscard]] static uint64_t memoryToRefine(const CodecState<D>& whole) {
    // Signs in chunks with their halo, and joined.
    return 3 * whole.memoryToRefine() + ChunkedLevel<D>::memoryOf(whole);
  }

  const RunTasks& runTasks_;
  ChunkedLevel<D> level_;
};

}  // namespace isostar
