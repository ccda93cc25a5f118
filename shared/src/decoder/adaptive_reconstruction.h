// A decoder's knowledge of an adaptive stream: layers in, surfaces out.
#pragma once

#include <algorithm>

#include "coding/adaptive/adaptive_field.h"
#include "surface/contour.h"
#include "coding/codec_state.h"
#include "surface/polygonizer.h"
#include "decoder/reconstruction.h"
#include "util/cold_path.h"

namespace isostar {

template <int D>
class AdaptiveReconstruction : public Reconstruction {
 public:
  AdaptiveReconstruction(const Header& header, const Limits& limits) : header_(header), limits_(limits), field_(header.base<D>()) {}

  ISOSTAR_SELDOM Outcome decode(const LayerHead& head, std::span<const std::byte> bytes, bool torn) override {
    constexpr std::size_t kTrimmed = 8;  // four bytes that the encoder may leave out, four that the decoder reads ahead
    if (!inOrder(head.kind, head.level)) return {Error::Corrupt};
    const bool geometry = head.kind == LayerKind::Octaves || head.kind == LayerKind::Halving;
    if (torn && !geometry) return {};  // an octave shows only as a whole
    GeometryPass<D> pass;
    pass.kind = head.kind;
    if (geometry) {
      ByteReader fields(bytes);
      if (!pass.read(fields)) return {Error::Corrupt};
      if (fields.overrun()) return {torn ? Error::None : Error::Corrupt};
      bytes = bytes.subspan(fields.position());
    }
    const uint64_t next = head.kind == LayerKind::Refinement ? field_.mesh.memoryToRefine() : head.kind == LayerKind::Octaves ? field_.memoryToTell() : 0;
    const uint64_t held = field_.memory();
    if (held + next > limits_.memory) return {Error::OverLimit};
    RangeDecoder coder(bytes);
    BlindExchange<D> ask(coder, torn ? 0 : kTrimmed, limits_.memory - held - (head.kind == LayerKind::Octaves ? next : 0));
    tell(ask, head.kind, pass);
    if (ask.overBudget()) return {Error::OverLimit};
    if (!torn && ask.spent()) return {Error::Corrupt};
    return {Error::None, true};
  }

  [[nodiscard]] int level() const override { return based_ ? field_.mesh.level() : -1; }

  Error show(const MeshOptions& options, Mesh& out) const override {
    out = {};
    if constexpr (D == 3) return make(options, out);
    else return Error::BadArgument;
  }
  Error show(const MeshOptions& options, Contours& out) const override {
    out = {};
    if constexpr (D == 2) return make(options, out);
    else return Error::BadArgument;
  }

 private:
  /// The base first, then each octave's mesh, then the scalars of each octave.
  [[nodiscard]] bool inOrder(LayerKind kind, int level) const {
    if (!based_) return kind == LayerKind::Base && level == 0;
    if (field_.mesh.level() < header_.octaves()) return kind == LayerKind::Refinement && level == field_.mesh.level() + 1;
    if (kind == LayerKind::Octaves) return level == field_.told() && level <= header_.octaves();
    return kind == LayerKind::Halving && level == field_.told() - 1;
  }

  template <class Exchange>
  void tell(Exchange& ask, LayerKind kind, const GeometryPass<D>& pass) {
    if (kind == LayerKind::Base) {
      field_.mesh.base(ask);
      based_ = true;
    } else if (kind == LayerKind::Refinement) {
      field_.mesh.refine(ask);
    } else if (kind == LayerKind::Octaves) {
      field_.tellOctaves(ask, pass.depth, header_.polygonizer);
    } else {
      field_.tellHalvings(ask, pass.halving(header_.fitted));
    }
  }

  template <class Out>
  Error make(const MeshOptions& options, Out& out) const {
    if (options.isovalue && *options.isovalue != header_.isovalue) return Error::BadArgument;
    if (!based_) return Error::None;
    uint64_t held = field_.memory();
    const auto octave = field_.shown(field_.mesh.level(), limits_.memory - std::min(held, limits_.memory));
    if (!octave) return Error::OverLimit;
    held += octave->memory();
    const double offset = 2 * header_.positiveOffset - 1;
    const Limits left{limits_.samples, limits_.vertices, limits_.memory - std::min(held, limits_.memory)};
    return polygonize(Surface<D>{octave->signs, octave->scalars, offset, offset, header_.placement}, options, left, out);
  }

  const Header& header_;
  const Limits limits_;
  AdaptiveField<D> field_;
  bool based_ = false;
};

}  // namespace isostar
