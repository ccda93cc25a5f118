// The decoder of a uniform stream in one dimension: layers in, surfaces out.
#pragma once

#include <algorithm>

#include "decoder/uniform_surfaces.h"
#include "surface/contour.h"
#include "surface/polygonizer.h"
#include "surface/time_slice.h"
#include "util/cold_path.h"

namespace isostar {

template <int D>
class UniformReconstruction : public Reconstruction, private UniformSurfaces<D> {
 public:
  UniformReconstruction(const Header& header, const Limits& limits, const RunTasks& runTasks)
      : UniformSurfaces<D>(header, limits, runTasks) {}

  ISOSTAR_COLD Outcome decode(const LayerHead& head, Sections sections, bool torn) override {
    if (!inOrder(head.kind, head.level)) return {Error::Corrupt};
    if (head.sections.size() > 1) return decodeChunks(head, sections, torn);
    if (sections.empty()) return {};
    const auto bytes = sections.front().bytes;
    if (torn && !showsTorn(head, bytes.size())) return {};
    LayerInput<D> input;
    if (const auto outcome = input.read(head.kind, bytes, torn)) return *outcome;
    const auto memory = state_.memoryFor(head.kind, input.pass.kind);
    if (memory.needed > limits_.memory) return {Error::OverLimit};
    RangeDecoder coder(input.coded);
    DecoderExchange<D> exchange(coder, torn ? 0 : input.kSlack, left(memory.fixed).memory,
                                limits_.decisions - work_);
    state_.code(exchange, head, input.pass);
    work_ += std::min(exchange.work(), limits_.decisions - work_);
    const Error error = exchange.overBudget()           ? Error::OverLimit
                        : !torn && exchange.exhausted() ? Error::Corrupt
                                                        : Error::None;
    trims_ = trims_ || (head.kind == LayerKind::Domain && error == Error::None);
    torn_ = torn || error != Error::None;
    based_ = based_ || error == Error::None;
    if (torn && head.kind == LayerKind::Refinement && error == Error::None)
      return {Error::None, showsUnfinished()};
    return {error, error == Error::None};
  }

  [[nodiscard]] int level() const override { return based_ ? state_.level : -1; }

  void beShare(bool isFirst) override { chunks_.beShare(isFirst); }
  [[nodiscard]] bool isDivided() const override { return chunks_.share().has_value(); }
  [[nodiscard]] bool isOpen() const override { return chunks_.isOpen(); }
  Error close() override { return chunks_.close(state_); }
  void results(std::vector<std::byte>& out) const override { chunks_.results(state_, out); }
  [[nodiscard]] bool take(std::span<const std::byte> bytes) override {
    return chunks_.take(bytes, state_);
  }

  Error show(const MeshOptions& options, Mesh& out) const override {
    return make(options, out, nullptr);
  }
  Error show(const MeshOptions& options, Mesh& out, std::vector<MeshRun>& runs) const override {
    MeshPart part{chunks_.share()->own(), {}};
    const Error error = make(options, out, &part);
    runs = std::move(part.runs);
    return error;
  }

  Error show(const MeshOptions& options, Contours& out) const override {
    out = {};
    if constexpr (D == 2) {
      if (!based_) return Error::None;
      return withSurface(options, [&](const Surface<2>& surface, uint64_t held) {
        return polygonize(surface, options, left(held), out);
      });
    } else {
      return Error::BadArgument;
    }
  }

 private:
  /// `part`: null for the whole.
  Error make(const MeshOptions& options, Mesh& out, MeshPart* part) const {
    out = {};
    if constexpr (D == 2) {
      return Error::BadArgument;
    } else {
      if constexpr (D == 4) {
        if (!(options.time >= 0 && options.time <= header_.size[3] - 1)) return Error::BadArgument;
      }
      if (!based_) return Error::None;
      // Not inlined: withSurface() calls it in several places.
      return withSurface(
          options, [&](const Surface<D>& surface, uint64_t held) __attribute__((noinline)) {
            if constexpr (D == 3) {
              return polygonize(surface, options, left(held), runTasks_, out, part);
            } else {
              held += memoryToSlice(surface);
              if (held > limits_.memory) return Error::OverLimit;
              const TimeSlice slice = sliceAt(surface, options.time);
              return polygonize(Surface<3>{slice.signs, slice.scalars, slice.positiveOffset,
                                           slice.negativeOffset, header_.placement},
                                options, left(held), runTasks_, out, part);
            }
          });
    }
  }

  ISOSTAR_COLD Outcome decodeChunks(const LayerHead& head, Sections sections, bool torn) {
    const uint64_t held = state_.memory() + chunks_.memory();
    typename ChunkDecoder<D>::Budget budget{limits_.memory - std::min(held, limits_.memory),
                                            limits_.decisions - work_};
    const Outcome outcome = chunks_.decode(head, sections, torn, state_, budget);
    work_ = limits_.decisions - budget.decisions;
    torn_ = torn || outcome.error != Error::None ||
            std::ranges::any_of(sections, [](const Section& s) { return !s.isWanted; });
    return outcome;
  }

  /// The base comes first, then each level, with displacements after any of them; then the domain;
  /// then geometry on the finest level; then signs and geometry of each further isovalue.
  [[nodiscard]] bool inOrder(LayerKind kind, int level) const {
    const int finestLevel = header_.finestLevel();
    if constexpr (kDecodesAll) {
      const int furtherCoded = static_cast<int>(state_.rare.further.surfaces().size());
      if (traitsOf(kind).isFurther) {
        return based_ && state_.level == finestLevel && level >= 1 &&
               level == furtherCoded + (kind == LayerKind::FurtherSigns ? 1 : 0);
      }
      if (furtherCoded != 0) return false;
    }
    if (!based_) return kind == LayerKind::Base && level == 0;
    if (state_.level < finestLevel && kind == LayerKind::Displacement)
      return !isPartial() && level == state_.level;
    if (state_.level < finestLevel)
      return kind == LayerKind::Refinement && level == state_.level + 1;
    if (header_.trimmed && !trims_) return kind == LayerKind::Domain && level == finestLevel;
    return (kind == LayerKind::Exponents || kind == LayerKind::Magnitudes ||
            kind == LayerKind::Displacement) &&
           level == finestLevel;
  }

  [[nodiscard]] bool showsTorn(const LayerHead& head, std::size_t bytes) const {
    if (head.kind == LayerKind::Refinement && isPartial()) return false;
    switch (traitsOf(head.kind).tornFrom) {
      case TornFrom::Never:
        return false;
      case TornFrom::Quarter:
        return 4 * bytes >= head.bytes;
      default:
        return true;
    }
  }
  /// Keeps an incomplete level, if the limits allow it. False if nothing new is shown.
  bool showsUnfinished() {
    if (state_.unfinished.table().total() == 0) return true;  // no part that matters was missing
    if (state_.memoryToKeepUnfinished() > limits_.memory) return false;
    state_.keepUnfinished();
    return !state_.coarser.empty();
  }

  using UniformSurfaces<D>::header_;
  using UniformSurfaces<D>::limits_;
  using UniformSurfaces<D>::runTasks_;
  using UniformSurfaces<D>::state_;
  using UniformSurfaces<D>::chunks_;
  using UniformSurfaces<D>::trims_;
  using UniformSurfaces<D>::torn_;
  using UniformSurfaces<D>::isPartial;
  using UniformSurfaces<D>::left;
  using UniformSurfaces<D>::withSurface;

  uint64_t work_ = 0;  // of all layers, as Limits::decisions counts it
  bool based_ = false;
};

}  // namespace isostar
