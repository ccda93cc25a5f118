// A decoder's knowledge of an adaptive stream: layers in, surfaces out.
#pragma once

#include <algorithm>

#include "coding/adaptive/adaptive_field.h"
#include "coding/codec_state.h"
#include "decoder/reconstruction.h"
#include "surface/contour.h"
#include "surface/polygonizer.h"
#include "util/cold_path.h"

namespace isostar {

template <int D>
class AdaptiveReconstruction : public Reconstruction {
 public:
  AdaptiveReconstruction(const Header& header, const Limits& limits)
      : header_(header), limits_(limits), field_(header.base<D>()) {}

  ISOSTAR_COLD Outcome decode(const LayerHead& head, std::span<const std::byte> bytes,
                              bool torn) override {
    constexpr std::size_t kTrimmed =
        8;  // four bytes that the encoder may leave out, four that the decoder reads ahead
    if (!inOrder(head.kind, head.level)) return {Error::Corrupt};
    const bool geometry = head.kind == LayerKind::Exponents || head.kind == LayerKind::Magnitudes;
    if (torn && !geometry) return {};  // an octave shows only as a whole
    GeometryPass<D> pass;
    pass.kind = head.kind;
    if (geometry) {
      ByteReader fields(bytes);
      if (!pass.read(fields)) return {Error::Corrupt};
      if (fields.overrun()) return {torn ? Error::None : Error::Corrupt};
      bytes = bytes.subspan(fields.position());
    }
    const uint64_t next = head.kind == LayerKind::Refinement  ? field_.mesh.memoryToRefine()
                          : head.kind == LayerKind::Exponents ? field_.memoryToCode()
                                                              : 0;
    const uint64_t held = field_.memory();
    if (held + next > limits_.memory) return {Error::OverLimit};
    RangeDecoder coder(bytes);
    DecoderExchange<D> exchange(
        coder, torn ? 0 : kTrimmed,
        limits_.memory - held - (head.kind == LayerKind::Exponents ? next : 0));
    code(exchange, head.kind, pass);
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
  /// The base first, then each octave's mesh, then the scalars of each octave.
  [[nodiscard]] bool inOrder(LayerKind kind, int level) const {
    if (!based_) return kind == LayerKind::Base && level == 0;
    if (field_.mesh.level() < header_.finestLevel())
      return kind == LayerKind::Refinement && level == field_.mesh.level() + 1;
    if (kind == LayerKind::Exponents)
      return level == field_.coded() && level <= header_.finestLevel();
    return kind == LayerKind::Magnitudes && level == field_.coded() - 1;
  }

  template <class Exchange>
  void code(Exchange& exchange, LayerKind kind, const GeometryPass<D>& pass) {
    if (kind == LayerKind::Base) {
      field_.mesh.base(exchange);
      based_ = true;
    } else if (kind == LayerKind::Refinement) {
      field_.mesh.refine(exchange);
    } else if (kind == LayerKind::Exponents) {
      field_.codeExponents(exchange, pass.depth, header_.polygonizer);
    } else {
      field_.codeMagnitudes(exchange, pass.magnitudePass(header_.fitted));
    }
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
                      limits_.memory - std::min(held, limits_.memory)};
    return polygonize(
        Surface<D>{adaptive->signs, adaptive->scalars, offset, offset, header_.placement}, options,
        left, out);
  }

  const Header& header_;
  const Limits limits_;
  AdaptiveField<D> field_;
  bool based_ = false;
};

}  // namespace isostar
