// What is known of a uniform stream so far, and its surfaces.
#pragma once

#include <algorithm>

#include "decoder/between.h"
#include "decoder/chunk_decoder.h"
#include "estimate/completion.h"
#include "surface/surface.h"
#include "util/cold_path.h"

namespace isostar {

template <int D>
class UniformSurfaces {
 protected:
  UniformSurfaces(const Header& header, const Limits& limits, const RunTasks& runTasks)
      : header_(header), limits_(limits), runTasks_(runTasks), state_(header), chunks_(runTasks) {}

  /// What is left of the limits while `held` bytes are in use.
  [[nodiscard]] Limits left(uint64_t held) const {
    return {limits_.samples, limits_.vertices, limits_.memory - std::min(held, limits_.memory),
            limits_.decisions};
  }

  /// Calls make(surface, bytes held) with the surface of the requested isovalue: as coded, or
  /// between coded ones.
  template <class Make>
  Error withSurface(const MeshOptions& options, Make make) const {
    const double isovalue = options.isovalue.value_or(header_.isovalue);
    uint64_t held = state_.memory() + chunks_.memory();
    if constexpr (kDecodesAll) {
      held += state_.rare.further.memory();
      if (const FurtherSurface<D>* further = state_.rare.further.find(isovalue)) {
        return withCompleted(
            {further->signs, further->active, further->scalars, further->coded, {state_.filter}},
            header_.at(isovalue), options, held, make);
      }
      if (isPartial()) return withPartial(held, make);
    }
    if (!state_.coarser.empty()) return withCoarser(held, make);
    if (state_.scalars.tableSize() == 0) return withEstimated(options, held, make);
    // Of a share only the bricks in which scalars are needed.
    std::vector<uint8_t> kept;
    if (chunks_.share()) {
      kept = state_.active;
      keepOnly(chunks_.share()->beside(), kept);
    }
    if constexpr (kDecodesAll) {
      if (isovalue != header_.isovalue) return withBetween(isovalue, options, held, make);
    }
    return withCompleted({state_.signs, chunks_.share() ? kept : state_.active, state_.scalars,
                          state_.coded, state_.hints(), !state_.magnitudesRefined},
                         header_, options, held, make);
  }

  /// Is the last level's mesh one that preserves the topology?
  [[nodiscard]] bool isPartial() const {
    if constexpr (kDecodesAll) return state_.rare.partial.has_value();
    return false;
  }

  const Header& header_;
  const Limits limits_;
  const RunTasks& runTasks_;
  CodecState<D> state_;
  ChunkDecoder<D> chunks_;
  bool trims_ = false, torn_ = false;

 private:
  /// What is known of the surface at one coded isovalue.
  struct Known {
    const Signs<D>& signs;
    const std::vector<uint8_t>& active;
    const Scalars<D>& scalars;
    const std::array<bool, 2>& coded;
    Hints<D> hints;
    bool smooth = false;  // do exponents alone determine most magnitudes?
  };

  /// For a mesh that has absent vertices.
  template <class Make>
  Error withPartial(uint64_t held, Make make) const {
    const auto adaptive =
        state_.rare.partial->shown(state_.rare.partial->mesh.level(), left(held).memory);
    if (!adaptive) return Error::OverLimit;
    const double offset = 2 * header_.positiveOffset - 1;
    return make(Surface<D>{adaptive->signs, adaptive->scalars, offset, offset, header_.placement},
                held + adaptive->memory());
  }

  /// For a last level that is known in parts.
  template <class Make>
  ISOSTAR_COLD Error withCoarser(uint64_t held, Make make) const {
    const std::size_t tableSize = state_.signs.table().total();
    held += Scalars<D>::memoryOf(tableSize, state_.scalars.brickCount());
    if (held > limits_.memory) return Error::OverLimit;
    const bool hasScalars = state_.scalars.tableSize() != 0;
    const KnownScalars<D> known(state_.signs.table(),
                                hasScalars ? state_.scalars : Scalars<D>(tableSize),
                                hasScalars && !state_.magnitudesRefined, state_.coarser.count());
    const auto level =
        state_.coarser.completed(state_.signs, state_.hints(), known, left(held).memory);
    if (!level) return Error::OverLimit;
    const double positive = 2 * header_.positiveOffset - 1,
                 negative = 2 * header_.negativeOffset - 1, scale = 1 << known.finer;
    return make(Surface<D>{level->signs, level->scalars, positive * scale, negative * scale,
                           header_.placement},
                held + level->memory());
  }

  /// Before any scalars are coded.
  template <class Make>
  Error withEstimated(const MeshOptions& options, uint64_t held, Make make) const {
    const std::size_t tableSize = state_.signs.table().total();
    held += tableSize + Scalars<D>::memoryOf(tableSize, 0);
    if (held > limits_.memory) return Error::OverLimit;
    auto active = activeBricks(state_.signs);
    if (chunks_.share()) keepOnly(chunks_.share()->beside(), active);
    return withCompleted(
        {state_.signs, active, Scalars<D>(tableSize), state_.coded, state_.hints()}, header_,
        options, held, make);
  }

  template <class Make>
  Error withBetween(double isovalue, const MeshOptions& options, uint64_t held, Make make) const {
    const auto& further = state_.rare.further;
    if (held + Between<D>::memoryToMake(further, state_.first(), isovalue) > limits_.memory)
      return Error::OverLimit;
    const double steps = (isovalue - header_.isovalue) / header_.quantizationStep;
    Between<D> between(further, state_.first(), isovalue, steps, header_.positiveOffset);
    held += between.memory();
    const uint64_t completed = memoryCompleted(between.scalars(), between.active());
    if (held + 2 * completed > limits_.memory) return Error::OverLimit;
    estimateMissing(between.signs(), between.active(), options.polygonizer, between.finer(),
                    between.scalars(), {state_.filter});
    return make(Surface<D>{between.signs(), between.scalars(), 0, 0, header_.placement},
                held + completed);
  }

  static void keepOnly(const std::vector<uint8_t>& marks, std::vector<uint8_t>& active) {
    for (std::size_t i = 0; i < active.size(); ++i) active[i] = active[i] & marks[i];
  }

  [[nodiscard]] const Scalars<D>* domain() const {
    if constexpr (kDecodesAll) return trims_ ? &state_.rare.domain : nullptr;
    return nullptr;
  }

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
};

}  // namespace isostar
