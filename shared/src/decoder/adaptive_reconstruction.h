// The decoder of an adaptive stream in one dimension: layers in, surfaces out.
#pragma once

#include <algorithm>

#include "coding/adaptive/adaptive_field.h"
#include "coding/codec_state.h"
#include "decoder/layer_input.h"
#include "decoder/reconstruction.h"
#include "surface/contour.h"
#include "surface/polygonizer.h"
#include "util/cold_path.h"

namespace isostar {

template <int D>
class AdaptiveReconstruction : public Reconstruction {
 public:
  AdaptiveReconstruction(const Header& header, const Limits& limits, const RunTasks& runTasks)
      : header_(header), limits_(limits), runTasks_(runTasks), field_(header.base<D>()) {}

  ISOSTAR_COLD Outcome decode(const LayerHead& head, Sections sections, bool torn) override {
    if (!inOrder(head.kind, head.level)) return {Error::Corrupt};
    if (sections.empty()) return {};
    const auto bytes = sections.front().bytes;
    if (torn && !traitsOf(head.kind).hasPass) return {};  // signs are shown only level by level
    LayerInput<D> input;
    if (const auto outcome = input.read(head.kind, bytes, torn)) return *outcome;
    const uint64_t next = head.kind == LayerKind::Refinement  ? field_.mesh.memoryToRefine()
                          : head.kind == LayerKind::Exponents ? field_.memoryToCode()
                                                              : 0;
    const uint64_t held = field_.memory();
    if (held + next > limits_.memory) return {Error::OverLimit};
    RangeDecoder coder(input.coded);
    DecoderExchange<D> exchange(
        coder, torn ? 0 : input.kSlack,
        limits_.memory - held - (head.kind == LayerKind::Exponents ? next : 0),
        limits_.decisions - work_);
    field_.code(exchange, input.pass, header_);
    work_ += std::min(exchange.work(), limits_.decisions - work_);
    based_ = true;
    if (exchange.overBudget()) return {Error::OverLimit};
    if (!torn && exchange.exhausted()) return {Error::Corrupt};
    return {Error::None, true};
  }

  [[nodiscard]] int level() const override { return based_ ? field_.mesh.level() : -1; }

  Error show(const MeshOptions& options, Mesh& out) const override {
    out = {};
    if constexpr (D == 3)
      return make(options, out);
    else
      return Error::BadArgument;
  }
  Error show(const MeshOptions& options, Contours& out) const override {
    out = {};
    if constexpr (D == 2)
      return make(options, out);
    else
      return Error::BadArgument;
  }

 private:
  /// The base comes first, then the mesh of each level, then the scalars of each level.
  [[nodiscard]] bool inOrder(LayerKind kind, int level) const {
    if (!based_) return kind == LayerKind::Base && level == 0;
    if (field_.mesh.level() < header_.finestLevel())
      return kind == LayerKind::Refinement && level == field_.mesh.level() + 1;
    if (kind == LayerKind::Exponents)
      return level == field_.codedLevels() && level <= header_.finestLevel();
    return kind == LayerKind::Magnitudes && level == field_.codedLevels() - 1;
  }

  template <class Out>
  Error make(const MeshOptions& options, Out& out) const {
    if (options.isovalue && *options.isovalue != header_.isovalue) return Error::BadArgument;
    if (!based_) return Error::None;
    uint64_t held = field_.memory();
    const auto adaptive =
        field_.shown(field_.mesh.level(), limits_.memory - std::min(held, limits_.memory));
    if (!adaptive) return Error::OverLimit;
    held += adaptive->memory();
    const double offset = 2 * header_.positiveOffset - 1;
    const Limits left{limits_.samples, limits_.vertices,
                      limits_.memory - std::min(held, limits_.memory), limits_.decisions};
    const Surface<D> surface{adaptive->signs, adaptive->scalars, offset, offset, header_.placement};
    if constexpr (D == 3)
      return polygonize(surface, options, left, runTasks_, out);
    else
      return polygonize(surface, options, left, out);
  }

  const Header& header_;
  const Limits limits_;
  const RunTasks& runTasks_;
  uint64_t work_ = 0;  // of all layers, as Limits::decisions counts it
  AdaptiveField<D> field_;
  bool based_ = false;
};

}  // namespace isostar
