// A decoder's knowledge in a dimension: layers in, surfaces out.
#pragma once

#include <algorithm>

#include "decoder/between.h"
#include "estimate/completion.h"
#include "surface/contour.h"
#include "coding/codec_state.h"
#include "surface/polygonizer.h"
#include "decoder/reconstruction.h"
#include "util/cold_path.h"
#include "surface/time_slice.h"

namespace isostar {

template <int D>
class ReconstructionIn : public Reconstruction {
 public:
  ReconstructionIn(const Header& header, const Limits& limits) : header_(header), limits_(limits), known_(header) {}

  ISOSTAR_SELDOM Outcome decode(const LayerHead& head, std::span<const std::byte> bytes, bool torn) override {
    constexpr std::size_t kTrimmed = 8;  // four bytes that the encoder may leave out, four that the decoder reads ahead
    if (!inOrder(head.kind, head.level)) return {Error::Corrupt};
    GeometryPass<D> pass;
    pass.kind = head.kind;
    const bool geometry = head.kind >= LayerKind::Octaves && head.kind != LayerKind::Domain && head.kind != LayerKind::NearSigns;
    if (torn && !showsTorn(head, bytes.size())) return {};
    if (geometry) {
      ByteReader fields(bytes);
      if (head.kind == LayerKind::NearGeometry) {
        pass.kind = static_cast<LayerKind>(fields.u8());
        if (!fields.overrun() && pass.kind != LayerKind::Octaves && pass.kind != LayerKind::Halving) return {Error::Corrupt};
      }
      if (!pass.read(fields)) return {Error::Corrupt};
      if (fields.overrun()) return {torn ? Error::None : Error::Corrupt};
      bytes = bytes.subspan(fields.position());
    }
    const Memory memory = memoryFor(head.kind, pass.kind);
    if (memory.needed > limits_.memory) return {Error::OverLimit};
    RangeDecoder coder(bytes);
    BlindExchange<D> ask(coder, torn ? 0 : kTrimmed, left(memory.settled).memory);
    if (head.kind == LayerKind::NearSigns) {
      known_.nearSigns(ask, head.level);
    } else if (head.kind == LayerKind::NearGeometry) {
      known_.nearGeometry(ask, pass);
    } else if (geometry) {
      known_.geometry(ask, pass);
    } else if (head.kind == LayerKind::Base) {
      known_.base(ask);
    } else if (head.kind == LayerKind::Domain) {
      known_.tellDomain(ask);
    } else {
      known_.refine(ask);
    }
    const Error error = ask.overBudget() ? Error::OverLimit : !torn && ask.spent() ? Error::Corrupt : Error::None;
    trims_ = trims_ || (head.kind == LayerKind::Domain && error == Error::None);
    torn_ = torn || error != Error::None;
    based_ = based_ || error == Error::None;
    if (torn && head.kind == LayerKind::Refinement && error == Error::None) return {Error::None, showsUnfinished()};
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
          return polygonize(Surface<3>{slice.signs, slice.scalars, slice.positiveOffset, slice.negativeOffset, header_.placement}, options, left(held),
                            out);
        }
      });
    }
  }

  Error show(const MeshOptions& options, Contours& out) const override {
    out = {};
    if constexpr (D == 2) {
      if (!based_) return Error::None;
      return withSurface(options, [&](const Surface<2>& surface, uint64_t held) { return polygonize(surface, options, left(held), out); });
    } else {
      return Error::BadArgument;
    }
  }

 private:
  /// The base first, then each octave, displacements after any of them, then where the domain ends, then geometry on the finest; then signs and geometry of each further isovalue.
  [[nodiscard]] bool inOrder(LayerKind kind, int level) const {
    const int octaves = header_.octaves(), nearTold = static_cast<int>(known_.near.surfaces().size());
    if (isNear(kind)) {
      return based_ && known_.level == octaves && level >= 1 && level == nearTold + (kind == LayerKind::NearSigns ? 1 : 0);
    }
    if (nearTold != 0) return false;
    if (!based_) return kind == LayerKind::Base && level == 0;
    if (known_.level < octaves && kind == LayerKind::Displacement) return !known_.partial && level == known_.level;
    if (known_.level < octaves) return kind == LayerKind::Refinement && level == known_.level + 1;
    if (header_.trimmed && !trims_) return kind == LayerKind::Domain && level == octaves;
    return (kind == LayerKind::Octaves || kind == LayerKind::Halving || kind == LayerKind::Displacement) && level == octaves;
  }

  /// Octaves, of vertices or of scalars, show in part if there is a quarter: where they meet what has not been told they are no better.
  [[nodiscard]] bool showsTorn(const LayerHead& head, std::size_t bytes) const {
    if (head.kind == LayerKind::Octaves || (head.kind == LayerKind::Refinement && !known_.partial)) return 4 * bytes >= head.bytes;
    return head.kind == LayerKind::Halving || head.kind == LayerKind::Displacement || head.kind == LayerKind::NearGeometry;
  }
  /// Takes over an octave that has been told in part, if the limits allow it.
  bool showsUnfinished() {
    if (known_.unfinished.table().total() == 0) return true;  // nothing that matters was missing
    if (known_.memoryToKeepUnfinished() > limits_.memory) return false;
    known_.keepUnfinished();
    return known_.partial.has_value();
  }

  /// What is left of the limits where so many bytes are held.
  [[nodiscard]] Limits left(uint64_t held) const { return {limits_.samples, limits_.vertices, limits_.memory - std::min(held, limits_.memory)}; }

  /// What a layer takes at most to begin with, and what stays as it is while it is decoded.
  struct Memory {
    uint64_t needed, settled;
  };
  [[nodiscard]] Memory memoryFor(LayerKind layer, LayerKind pass) const {
    const uint64_t all = known_.memory() + known_.near.memory();
    if (layer == LayerKind::Refinement) return {known_.memoryToRefine(), known_.memoryBesideScalars()};
    if (layer == LayerKind::NearSigns) return {all + known_.near.memoryToBegin(known_.first()), all - known_.near.memoryOfIntervals() + known_.signs.table().total()};
    if (layer == LayerKind::NearGeometry) return {all + (pass == LayerKind::Octaves ? known_.near.memoryToTell() : 0), 0};
    if (layer == LayerKind::Displacement) return {known_.memoryForDisplacements(), known_.memory() - known_.displacements.memory() + known_.memoryToFindActive()};
    return {known_.memoryForScalars(), known_.memoryBesideScalars() + known_.memoryToFindActive()};
  }

  /// What is known of the surface of one isovalue that has been told.
  struct Known {
    const Signs<D>& signs;
    const std::vector<uint8_t>& active;
    const Scalars<D>& scalars;
    const std::array<bool, 2>& told;
    Hints<D> hints;
    bool smooth = false;  // is only the octave of most magnitudes known?
  };

  /// Calls make(surface, bytes held) with the surface of the isovalue that is asked for: as it was told, or between those that were.
  template <class Make>
  Error withSurface(const MeshOptions& options, Make make) const {
    const double isovalue = options.isovalue.value_or(header_.isovalue);
    const uint64_t held = known_.memory() + known_.near.memory();
    if (const NearSurface<D>* near = known_.near.find(isovalue)) {
      return withCompleted({near->signs, near->active, near->scalars, near->told, {known_.kernel}}, header_.at(isovalue), options, held, make);
    }
    if (known_.partial) return withPartial(held, make);
    if (known_.scalars.places() == 0) return withEstimated(options, held, make);
    if (isovalue == header_.isovalue) return withCompleted({known_.signs, known_.active, known_.scalars, known_.told, known_.hints(), !known_.halved}, header_, options, held, make);
    return withBetween(isovalue, options, held, make);
  }

  /// Of a mesh that has not all vertices yet.
  template <class Make>
  Error withPartial(uint64_t held, Make make) const {
    const auto octave = known_.partial->shown(known_.partial->mesh.level(), left(held).memory);
    if (!octave) return Error::OverLimit;
    const double offset = 2 * header_.positiveOffset - 1;
    return make(Surface<D>{octave->signs, octave->scalars, offset, offset, header_.placement}, held + octave->memory());
  }

  /// Before any scalars have been told.
  template <class Make>
  Error withEstimated(const MeshOptions& options, uint64_t held, Make make) const {
    const std::size_t places = known_.signs.table().total();
    held += places + Scalars<D>::memoryOf(places, 0);
    if (held > limits_.memory) return Error::OverLimit;
    const auto active = activeBricks(known_.signs);
    return withCompleted({known_.signs, active, Scalars<D>(places), known_.told, known_.hints()}, header_, options, held, make);
  }

  template <class Make>
  Error withBetween(double isovalue, const MeshOptions& options, uint64_t held, Make make) const {
    if (held + Between<D>::memoryToMake(known_.near, known_.first(), isovalue) > limits_.memory) return Error::OverLimit;
    const double quanta = (isovalue - header_.isovalue) / header_.quantum;
    Between<D> between(known_.near, known_.first(), isovalue, quanta, header_.positiveOffset);
    held += between.memory();
    const uint64_t completed = memoryCompleted(between.scalars(), between.active());
    if (held + 2 * completed > limits_.memory) return Error::OverLimit;
    estimateMissing(between.signs(), between.active(), options.polygonizer, between.finer(), between.scalars(), {known_.kernel});
    return make(Surface<D>{between.signs(), between.scalars(), 0, 0, header_.placement}, held + completed);
  }

  [[nodiscard]] const Scalars<D>* domain() const { return trims_ ? &known_.domain : nullptr; }

  /// With scalars for all vertices that the polygonizer needs, told or estimated.
  template <class Make>
  Error withCompleted(const Known& known, const Header& header, const MeshOptions& options, uint64_t held, Make make) const {
    const double positive = 2 * header.positiveOffset - 1, negative = 2 * header.negativeOffset - 1;
    if (!torn_ && !known.smooth && known.told[0] && (known.told[1] || options.polygonizer == Polygonizer::Cubes)) {
      return make(Surface<D>{known.signs, known.scalars, positive, negative, header_.placement, domain()}, held);
    }
    const uint64_t completed = memoryCompleted(known.scalars, known.active);
    if (held + 2 * completed > limits_.memory) return Error::OverLimit;
    const Completed<D> full(known.signs, known.active, known.scalars, options.polygonizer, known.hints, known.smooth);
    const double scale = 1 << full.finer;
    return make(Surface<D>{known.signs, full.scalars, positive * scale, negative * scale, header_.placement, domain()}, held + completed);
  }

  /// Of scalars with estimates in all active bricks; while they are made, those before are kept, too.
  [[nodiscard]] static uint64_t memoryCompleted(const Scalars<D>& scalars, const std::vector<uint8_t>& active) {
    uint64_t bricks = 0;
    for (std::size_t place = 0; place < active.size(); ++place) bricks += active[place] != 0 || scalars.has(place) ? 1 : 0;
    return Scalars<D>::memoryOf(active.size(), bricks);
  }

  const Header& header_;
  const Limits limits_;
  Knowledge<D> known_;
  bool based_ = false, trims_ = false, torn_ = false;
};

}  // namespace isostar
