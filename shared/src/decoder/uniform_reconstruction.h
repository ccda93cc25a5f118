// A decoder's knowledge in a dimension: layers in, surfaces out.
#pragma once

#include <algorithm>

#include "coding/codec_state.h"
#include "decoder/between.h"
#include "decoder/reconstruction.h"
#include "estimate/completion.h"
#include "surface/contour.h"
#include "surface/polygonizer.h"
#include "surface/time_slice.h"
#include "util/cold_path.h"

namespace isostar {

template <int D>
class UniformReconstruction : public Reconstruction {
 public:
  UniformReconstruction(const Header& header, const Limits& limits)
      : header_(header), limits_(limits), known_(header) {}

  ISOSTAR_COLD Outcome decode(const LayerHead& head, std::span<const std::byte> bytes,
                              bool torn) override {
    constexpr std::size_t kTrimmed =
        8;  // four bytes that the encoder may leave out, four that the decoder reads ahead
    if (!inOrder(head.kind, head.level)) return {Error::Corrupt};
    GeometryPass<D> pass;
    pass.kind = head.kind;
    const bool geometry = head.kind >= LayerKind::Exponents && head.kind != LayerKind::Domain &&
                          head.kind != LayerKind::FurtherSigns;
    if (torn && !showsTorn(head, bytes.size())) return {};
    if (geometry) {
      ByteReader fields(bytes);
      if (head.kind == LayerKind::FurtherGeometry) {
        pass.kind = static_cast<LayerKind>(fields.u8());
        if (!fields.overrun() && pass.kind != LayerKind::Exponents &&
            pass.kind != LayerKind::Magnitudes)
          return {Error::Corrupt};
      }
      if (!pass.read(fields)) return {Error::Corrupt};
      if (fields.overrun()) return {torn ? Error::None : Error::Corrupt};
      bytes = bytes.subspan(fields.position());
    }
    const Memory memory = memoryFor(head.kind, pass.kind);
    if (memory.needed > limits_.memory) return {Error::OverLimit};
    RangeDecoder coder(bytes);
    DecoderExchange<D> exchange(coder, torn ? 0 : kTrimmed, left(memory.settled).memory);
    if (head.kind == LayerKind::FurtherSigns) {
      known_.furtherSigns(exchange, head.level);
    } else if (head.kind == LayerKind::FurtherGeometry) {
      known_.furtherGeometry(exchange, pass);
    } else if (geometry) {
      known_.geometry(exchange, pass);
    } else if (head.kind == LayerKind::Base) {
      known_.base(exchange);
    } else if (head.kind == LayerKind::Domain) {
      known_.codeDomain(exchange);
    } else {
      known_.refine(exchange);
    }
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

  [[nodiscard]] int level() const override { return based_ ? known_.level : -1; }

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
          return polygonize(surface, options, left(held), out);
        } else {
          held += memoryToSlice(surface);
          if (held > limits_.memory) return Error::OverLimit;
          const TimeSlice slice = sliceAt(surface, options.time);
          return polygonize(Surface<3>{slice.signs, slice.scalars, slice.positiveOffset,
                                       slice.negativeOffset, header_.placement},
                            options, left(held), out);
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
  /// The base first, then each octave, displacements after any of them, then where the domain ends,
  /// then geometry on the finest; then signs and geometry of each further isovalue.
  [[nodiscard]] bool inOrder(LayerKind kind, int level) const {
    const int finestLevel = header_.finestLevel(),
              furtherCoded = static_cast<int>(known_.further.surfaces().size());
    if (isFurther(kind)) {
      return based_ && known_.level == finestLevel && level >= 1 &&
             level == furtherCoded + (kind == LayerKind::FurtherSigns ? 1 : 0);
    }
    if (furtherCoded != 0) return false;
    if (!based_) return kind == LayerKind::Base && level == 0;
    if (known_.level < finestLevel && kind == LayerKind::Displacement)
      return !known_.partial && level == known_.level;
    if (known_.level < finestLevel)
      return kind == LayerKind::Refinement && level == known_.level + 1;
    if (header_.trimmed && !trims_) return kind == LayerKind::Domain && level == finestLevel;
    return (kind == LayerKind::Exponents || kind == LayerKind::Magnitudes ||
            kind == LayerKind::Displacement) &&
           level == finestLevel;
  }

  /// Octaves, of vertices or of scalars, show in part if there is a quarter: where they meet what
  /// has not been told they are no better.
  [[nodiscard]] bool showsTorn(const LayerHead& head, std::size_t bytes) const {
    if (head.kind == LayerKind::Exponents ||
        (head.kind == LayerKind::Refinement && !known_.partial))
      return 4 * bytes >= head.bytes;
    return head.kind == LayerKind::Magnitudes || head.kind == LayerKind::Displacement ||
           head.kind == LayerKind::FurtherGeometry;
  }
  /// Takes over an octave that has been told in part, if the limits allow it.
  bool showsUnfinished() {
    if (known_.unfinished.table().total() == 0) return true;  // nothing that matters was missing
    if (known_.memoryToKeepUnfinished() > limits_.memory) return false;
    known_.keepUnfinished();
    return known_.partial.has_value();
  }

  /// What is left of the limits where so many bytes are held.
  [[nodiscard]] Limits left(uint64_t held) const {
    return {limits_.samples, limits_.vertices, limits_.memory - std::min(held, limits_.memory)};
  }

  /// What a layer takes at most to begin with, and what stays as it is while it is decoded.
  struct Memory {
    uint64_t needed, settled;
  };
  [[nodiscard]] Memory memoryFor(LayerKind layer, LayerKind pass) const {
    const uint64_t all = known_.memory() + known_.further.memory();
    if (layer == LayerKind::Refinement)
      return {known_.memoryToRefine(), known_.memoryBesideScalars()};
    if (layer == LayerKind::FurtherSigns)
      return {all + known_.further.memoryToBegin(known_.first()),
              all - known_.further.memoryOfIntervals() + known_.signs.table().total()};
    if (layer == LayerKind::FurtherGeometry)
      return {all + (pass == LayerKind::Exponents ? known_.further.memoryToCode() : 0), 0};
    if (layer == LayerKind::Displacement)
      return {known_.memoryForDisplacements(),
              known_.memory() - known_.displacements.memory() + known_.memoryToFindActive()};
    return {known_.memoryForScalars(), known_.memoryBesideScalars() + known_.memoryToFindActive()};
  }

  /// What is known of the surface of one isovalue that has been told.
  struct Known {
    const Signs<D>& signs;
    const std::vector<uint8_t>& active;
    const Scalars<D>& scalars;
    const std::array<bool, 2>& coded;
    Hints<D> hints;
    bool smooth = false;  // is only the octave of most magnitudes known?
  };

  /// Calls make(surface, bytes held) with the surface of the isovalue that is asked for: as it was
  /// told, or between those that were.
  template <class Make>
  Error withSurface(const MeshOptions& options, Make make) const {
    const double isovalue = options.isovalue.value_or(header_.isovalue);
    const uint64_t held = known_.memory() + known_.further.memory();
    if (const FurtherSurface<D>* near = known_.further.find(isovalue)) {
      return withCompleted({near->signs, near->active, near->scalars, near->coded, {known_.filter}},
                           header_.at(isovalue), options, held, make);
    }
    if (known_.partial) return withPartial(held, make);
    if (known_.scalars.tableSize() == 0) return withEstimated(options, held, make);
    if (isovalue == header_.isovalue)
      return withCompleted({known_.signs, known_.active, known_.scalars, known_.coded,
                            known_.hints(), !known_.magnitudesRefined},
                           header_, options, held, make);
    return withBetween(isovalue, options, held, make);
  }

  /// Of a mesh that has not all vertices yet.
  template <class Make>
  Error withPartial(uint64_t held, Make make) const {
    const auto adaptive = known_.partial->shown(known_.partial->mesh.level(), left(held).memory);
    if (!adaptive) return Error::OverLimit;
    const double offset = 2 * header_.positiveOffset - 1;
    return make(Surface<D>{adaptive->signs, adaptive->scalars, offset, offset, header_.placement},
                held + adaptive->memory());
  }

  /// Before any scalars have been told.
  template <class Make>
  Error withEstimated(const MeshOptions& options, uint64_t held, Make make) const {
    const std::size_t brickIndices = known_.signs.table().total();
    held += brickIndices + Scalars<D>::memoryOf(brickIndices, 0);
    if (held > limits_.memory) return Error::OverLimit;
    const auto active = activeBricks(known_.signs);
    return withCompleted(
        {known_.signs, active, Scalars<D>(brickIndices), known_.coded, known_.hints()}, header_,
        options, held, make);
  }

  template <class Make>
  Error withBetween(double isovalue, const MeshOptions& options, uint64_t held, Make make) const {
    if (held + Between<D>::memoryToMake(known_.further, known_.first(), isovalue) > limits_.memory)
      return Error::OverLimit;
    const double steps = (isovalue - header_.isovalue) / header_.quantizationStep;
    Between<D> between(known_.further, known_.first(), isovalue, steps, header_.positiveOffset);
    held += between.memory();
    const uint64_t completed = memoryCompleted(between.scalars(), between.active());
    if (held + 2 * completed > limits_.memory) return Error::OverLimit;
    estimateMissing(between.signs(), between.active(), options.polygonizer, between.finer(),
                    between.scalars(), {known_.filter});
    return make(Surface<D>{between.signs(), between.scalars(), 0, 0, header_.placement},
                held + completed);
  }

  [[nodiscard]] const Scalars<D>* domain() const { return trims_ ? &known_.domain : nullptr; }

  /// With scalars for all vertices that the polygonizer needs, told or estimated.
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

  /// Of scalars with estimates in all active bricks; while they are made, those before are kept,
  /// too.
  [[nodiscard]] static uint64_t memoryCompleted(const Scalars<D>& scalars,
                                                const std::vector<uint8_t>& active) {
    uint64_t bricks = 0;
    for (std::size_t brickIndex = 0; brickIndex < active.size(); ++brickIndex)
      bricks += active[brickIndex] != 0 || scalars.has(brickIndex) ? 1 : 0;
    return Scalars<D>::memoryOf(active.size(), bricks);
  }

  const Header& header_;
  const Limits limits_;
  CodecState<D> known_;
  bool based_ = false, trims_ = false, torn_ = false;
};

}  // namespace isostar
