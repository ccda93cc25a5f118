// A decoder's knowledge in a dimension: layers in, surfaces out.
#pragma once

#include <algorithm>

#include "between.h"
#include "completion.h"
#include "contour.h"
#include "layers.h"
#include "polygonizer.h"
#include "reconstruction.h"
#include "time_slice.h"

namespace isostar {

template <int D>
class ReconstructionIn : public Reconstruction {
 public:
  ReconstructionIn(const Header& header, const Limits& limits) : header_(header), limits_(limits), known_(header) {}

  Outcome decode(const LayerHead& head, std::span<const std::byte> bytes, bool torn) override {
    constexpr std::size_t kTrimmed = 8;  // four bytes that the encoder may leave out, four that the decoder reads ahead
    if (!inOrder(head.kind, head.level)) return {Error::Corrupt};
    GeometryPass<D> pass;
    pass.kind = head.kind;
    const bool geometry = head.kind == LayerKind::Octaves || head.kind == LayerKind::Halving || head.kind == LayerKind::NearGeometry;
    torn_ = torn;
    if (torn && !geometry) return {};  // an octave shows only as a whole
    if (geometry) {
      ByteReader fields(bytes);
      if (head.kind == LayerKind::NearGeometry) pass.kind = static_cast<LayerKind>(fields.u8());
      if (!fields.overrun() && pass.kind != LayerKind::Octaves && pass.kind != LayerKind::Halving) return {Error::Corrupt};
      if (!pass.read(fields)) return {Error::Corrupt};
      if (fields.overrun()) return {torn ? Error::None : Error::Corrupt};
      bytes = bytes.subspan(fields.position());
    }
    if (head.kind == LayerKind::Refinement && memoryToRefine() > limits_.memory) return {Error::OverLimit};
    std::size_t settled = geometry ? known_.signs.memory() : 0;
    if (isNear(head.kind)) settled += known_.scalars.memory() + known_.near.memory();
    if (head.kind == LayerKind::NearSigns && settled + known_.near.memoryToBegin(known_.first()) > limits_.memory) return {Error::OverLimit};
    RangeDecoder coder(bytes);
    BlindExchange<D> ask(coder, torn ? 0 : kTrimmed, limits_.memory - std::min<std::size_t>(settled, limits_.memory));
    if (head.kind == LayerKind::NearSigns) {
      known_.nearSigns(ask, head.level);
    } else if (head.kind == LayerKind::NearGeometry) {
      known_.nearGeometry(ask, pass);
    } else if (geometry) {
      known_.geometry(ask, pass);
    } else if (head.kind == LayerKind::Base) {
      known_.base(ask);
      based_ = true;
    } else {
      known_.refine(ask);
    }
    if (ask.overBudget()) return {Error::OverLimit};
    if (!torn && ask.spent()) return {Error::Corrupt};
    return {Error::None, true};
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
      return withSurface(options, [&](const Surface<D>& surface) {
        if constexpr (D == 3) {
          return polygonize(surface, options, limits_.vertices, out);
        } else {
          const TimeSlice slice = sliceAt(surface, options.time);
          return polygonize(Surface<3>{slice.signs, slice.scalars, slice.positiveOffset, slice.negativeOffset, header_.placement}, options,
                            limits_.vertices, out);
        }
      });
    }
  }

  Error show(const MeshOptions& options, Contours& out) const override {
    out = {};
    if constexpr (D == 2) {
      if (!based_) return Error::None;
      return withSurface(options, [&](const Surface<2>& surface) { return polygonize(surface, options, limits_.vertices, out); });
    } else {
      return Error::BadArgument;
    }
  }

 private:
  /// The base first, then each octave, then geometry on the finest; then signs and geometry of each further isovalue.
  [[nodiscard]] bool inOrder(LayerKind kind, int level) const {
    const int octaves = header_.octaves(), nearTold = static_cast<int>(known_.near.surfaces().size());
    if (isNear(kind)) {
      return based_ && known_.level == octaves && level >= 1 && level == nearTold + (kind == LayerKind::NearSigns ? 1 : 0);
    }
    if (nearTold != 0) return false;
    if (!based_) return kind == LayerKind::Base && level == 0;
    if (known_.level < octaves) return kind == LayerKind::Refinement && level == known_.level + 1;
    return (kind == LayerKind::Octaves || kind == LayerKind::Halving) && level == octaves;
  }

  /// What it takes at most to begin the next octave: both octaves' tables, a mark for each place, 2^D bricks for one.
  [[nodiscard]] std::size_t memoryToRefine() const {
    const std::size_t places = BrickTable<D>(known_.signs.lattice().finer()).total();
    return known_.signs.memory() + places * (sizeof(uint32_t) + 1) + (std::size_t{known_.signs.brickCount()} << D) * sizeof(Brick<D>);
  }

  /// What is known of the surface of one isovalue that has been told.
  struct Known {
    const Signs<D>& signs;
    const std::vector<uint8_t>& active;
    const Scalars<D>& scalars;
    const std::array<bool, 2>& told;
  };

  /// Calls make(surface) with the surface of the isovalue that is asked for: as it was told, or between those that were.
  template <class Make>
  Error withSurface(const MeshOptions& options, Make make) const {
    const double isovalue = options.isovalue.value_or(header_.isovalue);
    if (const NearSurface<D>* near = known_.near.find(isovalue)) {
      return withCompleted({near->signs, near->active, near->scalars, near->told}, header_.at(isovalue), options, make);
    }
    if (isovalue == header_.isovalue || known_.active.empty()) {
      const auto active = known_.active.empty() ? activeBricks(known_.signs) : known_.active;
      return withCompleted({known_.signs, active, known_.active.empty() ? Scalars<D>(active.size()) : known_.scalars, known_.told}, header_, options, make);
    }
    const double quanta = (isovalue - header_.isovalue) / header_.quantum;
    Between<D> between(known_.near, known_.first(), isovalue, quanta, header_.positiveOffset);
    estimate(between.signs(), between.active(), options, between.finer(), between.scalars());
    return make(Surface<D>{between.signs(), between.scalars(), 0, 0, header_.placement});
  }

  /// With scalars for all vertices that the polygonizer needs, told or estimated.
  template <class Make>
  Error withCompleted(const Known& known, const Header& header, const MeshOptions& options, Make make) const {
    const double positive = 2 * header.positiveOffset - 1, negative = 2 * header.negativeOffset - 1;
    if (!torn_ && known.told[0] && (known.told[1] || options.polygonizer == Polygonizer::Cubes)) {
      return make(Surface<D>{known.signs, known.scalars, positive, negative, header_.placement});
    }
    Scalars<D> scalars = known.scalars;
    const int finer = scalars.magnify();
    const double scale = 1 << finer;
    estimate(known.signs, known.active, options, finer, scalars);
    return make(Surface<D>{known.signs, scalars, positive * scale, negative * scale, header_.placement});
  }

  static void estimate(const Signs<D>& signs, const std::vector<uint8_t>& active, const MeshOptions& options, int finer, Scalars<D>& scalars) {
    estimateMissing(signs, active, Members::AxisEnds, finer, scalars);
    if (options.polygonizer == Polygonizer::Tetrahedra) estimateMissing(signs, active, Members::DiagonalEnds, finer, scalars);
  }

  const Header& header_;
  const Limits limits_;
  Knowledge<D> known_;
  bool based_ = false, torn_ = false;
};

}  // namespace isostar
