// The decoder of a uniform stream in one dimension: layers in, surfaces out.
#pragma once

#include <algorithm>

#include "decoder/between.h"
#include "decoder/chunk_decoder.h"
#include "estimate/completion.h"
#include "surface/contour.h"
#include "surface/polygonizer.h"
#include "surface/time_slice.h"
#include "util/cold_path.h"

namespace isostar {

template <int D>
class UniformReconstruction : public Reconstruction {
 public:
  UniformReconstruction(const Header& header, const Limits& limits, const RunTasks& runTasks)
      : header_(header), limits_(limits), runTasks_(runTasks), state_(header), chunks_(runTasks) {}

  ISOSTAR_COLD Outcome decode(const LayerHead& head, Sections sections, bool torn) override {
    if (!inOrder(head.kind, head.level)) return {Error::Corrupt};
    if (head.sections.size() > 1) return decodeChunks(head, sections, torn);
    if (sections.empty()) return {};
    const auto bytes = sections.front();
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

  Error show(const MeshOptions& options, Mesh& out) const override {
    out = {};
    if constexpr (D == 2) {
      return Error::BadArgument;
    } else {
      if constexpr (D == 4) {
        if (!(options.time >= 0 && options.time <= header_.size[3] - 1)) return Error::BadArgument;
      }
      if (!based_) return Error::None;
      return withSurface(options, [&](const Surface<D>& surface, uint64_t held) {
        if constexpr (D == 3) {
          return polygonize(surface, options, left(held), runTasks_, out);
        } else {
          held += memoryToSlice(surface);
          if (held > limits_.memory) return Error::OverLimit;
          const TimeSlice slice = sliceAt(surface, options.time);
          return polygonize(Surface<3>{slice.signs, slice.scalars, slice.positiveOffset,
                                       slice.negativeOffset, header_.placement},
                            options, left(held), runTasks_, out);
        }
      });
    }
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
  ISOSTAR_COLD Outcome decodeChunks(const LayerHead& head, Sections sections, bool torn) {
    const uint64_t held = state_.memory() + chunks_.memory();
    typename ChunkDecoder<D>::Budget budget{limits_.memory - std::min(held, limits_.memory),
                                            limits_.decisions - work_};
    const Outcome outcome = chunks_.decode(head, sections, torn, state_, budget);
    work_ = limits_.decisions - budget.decisions;
    torn_ = torn || outcome.error != Error::None;
    return outcome;
  }

  /// The base comes first, then each level, with displacements after any of them; then the domain;
  /// then geometry on the finest level; then signs and geometry of each further isovalue.
  [[nodiscard]] bool inOrder(LayerKind kind, int level) const {
    const int finestLevel = header_.finestLevel(),
              furtherCoded = static_cast<int>(state_.further.surfaces().size());
    if (traitsOf(kind).isFurther) {
      return based_ && state_.level == finestLevel && level >= 1 &&
             level == furtherCoded + (kind == LayerKind::FurtherSigns ? 1 : 0);
    }
    if (furtherCoded != 0) return false;
    if (!based_) return kind == LayerKind::Base && level == 0;
    if (state_.level < finestLevel && kind == LayerKind::Displacement)
      return !state_.partial && level == state_.level;
    if (state_.level < finestLevel)
      return kind == LayerKind::Refinement && level == state_.level + 1;
    if (header_.trimmed && !trims_) return kind == LayerKind::Domain && level == finestLevel;
    return (kind == LayerKind::Exponents || kind == LayerKind::Magnitudes ||
            kind == LayerKind::Displacement) &&
           level == finestLevel;
  }

  [[nodiscard]] bool showsTorn(const LayerHead& head, std::size_t bytes) const {
    if (head.kind == LayerKind::Refinement && state_.partial) return false;
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
    return state_.partial.has_value();
  }

  /// What is left of the limits while `held` bytes are in use.
  [[nodiscard]] Limits left(uint64_t held) const {
    return {limits_.samples, limits_.vertices, limits_.memory - std::min(held, limits_.memory),
            limits_.decisions};
  }

  /// What is known of the surface at one coded isovalue.
  struct Known {
    const Signs<D>& signs;
    const std::vector<uint8_t>& active;
    const Scalars<D>& scalars;
    const std::array<bool, 2>& coded;
    Hints<D> hints;
    bool smooth = false;  // do exponents alone determine most magnitudes?
  };

  /// Calls make(surface, bytes held) with the surface of the requested isovalue: as coded, or
  /// between coded ones.
  template <class Make>
  Error withSurface(const MeshOptions& options, Make make) const {
    const double isovalue = options.isovalue.value_or(header_.isovalue);
    const uint64_t held = state_.memory() + state_.further.memory() + chunks_.memory();
    if (const FurtherSurface<D>* further = state_.further.find(isovalue)) {
      return withCompleted(
          {further->signs, further->active, further->scalars, further->coded, {state_.filter}},
          header_.at(isovalue), options, held, make);
    }
    if (state_.partial) return withPartial(held, make);
    if (state_.scalars.tableSize() == 0) return withEstimated(options, held, make);
    if (isovalue == header_.isovalue)
      return withCompleted({state_.signs, state_.active, state_.scalars, state_.coded,
                            state_.hints(), !state_.magnitudesRefined},
                           header_, options, held, make);
    return withBetween(isovalue, options, held, make);
  }

  /// For a mesh that has absent vertices.
  template <class Make>
  Error withPartial(uint64_t held, Make make) const {
    const auto adaptive = state_.partial->shown(state_.partial->mesh.level(), left(held).memory);
    if (!adaptive) return Error::OverLimit;
    const double offset = 2 * header_.positiveOffset - 1;
    return make(Surface<D>{adaptive->signs, adaptive->scalars, offset, offset, header_.placement},
                held + adaptive->memory());
  }

  /// Before any scalars are coded.
  template <class Make>
  Error withEstimated(const MeshOptions& options, uint64_t held, Make make) const {
    const std::size_t tableSize = state_.signs.table().total();
    held += tableSize + Scalars<D>::memoryOf(tableSize, 0);
    if (held > limits_.memory) return Error::OverLimit;
    const auto active = activeBricks(state_.signs);
    return withCompleted(
        {state_.signs, active, Scalars<D>(tableSize), state_.coded, state_.hints()}, header_,
        options, held, make);
  }

  template <class Make>
  Error withBetween(double isovalue, const MeshOptions& options, uint64_t held, Make make) const {
    if (held + Between<D>::memoryToMake(state_.further, state_.first(), isovalue) > limits_.memory)
      return Error::OverLimit;
    const double steps = (isovalue - header_.isovalue) / header_.quantizationStep;
    Between<D> between(state_.further, state_.first(), isovalue, steps, header_.positiveOffset);
    held += between.memory();
    const uint64_t completed = memoryCompleted(between.scalars(), between.active());
    if (held + 2 * completed > limits_.memory) return Error::OverLimit;
    estimateMissing(between.signs(), between.active(), options.polygonizer, between.finer(),
                    between.scalars(), {state_.filter});
    return make(Surface<D>{between.signs(), between.scalars(), 0, 0, header_.placement},
                held + completed);
  }

  [[nodiscard]] const Scalars<D>* domain() const { return trims_ ? &state_.domain : nullptr; }

  /// With scalars, coded or estimated, for all vertices that the polygonizer needs.
  template <class Make>
  Error withCompleted(const Known& known, const Header& header, const MeshOptions& options,
                      uint64_t held, Make make) const {
    const double positive = 2 * header.positiveOffset - 1, negative = 2 * header.negativeOffset - 1;
    if (!torn_ && !known.smooth && known.coded[0] &&
        (known.coded[1] || options.polygonizer == Polygonizer::Cubes)) {
      return make(
          Surface<D>{known.signs, known.scalars, positive, negative, header_.placement, domain()},
          held);
    }
    const uint64_t completed = memoryCompleted(known.scalars, known.active);
    if (held + 2 * completed > limits_.memory) return Error::OverLimit;
    const Completed<D> full(known.signs, known.active, known.scalars, options.polygonizer,
                            known.hints, known.smooth);
    const double scale = 1 << full.finer;
    return make(Surface<D>{known.signs, full.scalars, positive * scale, negative * scale,
                           header_.placement, domain()},
                held + completed);
  }

  /// Bytes of scalars that have estimates in all active bricks. While they are made, the coded
  /// scalars are in use, too.
  [[nodiscard]] static uint64_t memoryCompleted(const Scalars<D>& scalars,
                                                const std::vector<uint8_t>& active) {
    uint64_t bricks = 0;
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex)
      bricks += active[brickIndex] != 0 || scalars.has(brickIndex) ? 1 : 0;
    return Scalars<D>::memoryOf(active.size(), bricks);
  }

  const Header& header_;
  const Limits limits_;
  const RunTasks& runTasks_;
  uint64_t work_ = 0;  // of all layers, as Limits::decisions counts it
  CodecState<D> state_;
  ChunkDecoder<D> chunks_;
  bool based_ = false, trims_ = false, torn_ = false;
};

}  // namespace isostar
