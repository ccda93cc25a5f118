// A stream's layers as one traversal for both directions: the encoder tells, the decoder listens.
#pragma once

#include "base_coder.h"
#include "geometry_coder.h"
#include "refinement_coder.h"
#include "stream.h"

namespace isostar {

/// What a geometry layer is to do, decided by the encoder.
struct GeometryPass {
  LayerKind kind = LayerKind::Octaves;
  Members members = Members::AxisEnds;
  int depth = 3;                         // Octaves: of the floor below the gradient
  GeometryCoder<3>::Allowed allowed{};   // Halving
  int most = 1;                          // Halving: of one interval
  bool selective = false;                // Halving: only in bricks that are told

  void write(ByteWriter& out) const {
    out.u8(static_cast<uint64_t>(members));
    if (kind == LayerKind::Octaves) {
      out.u8(static_cast<uint64_t>(depth));
      return;
    }
    for (std::size_t axes = 1; axes < allowed.size(); ++axes) out.varint(allowed[axes]);
    out.u8(static_cast<uint64_t>(most));
    out.u8(selective ? 1 : 0);
  }
  /// False where a field is out of its range.
  [[nodiscard]] bool read(ByteReader& in) {
    const uint32_t m = in.u8();
    members = static_cast<Members>(m);
    bool sane = m <= static_cast<uint32_t>(Members::DiagonalEnds);
    if (kind == LayerKind::Octaves) {
      depth = static_cast<int>(in.u8());
      return sane && depth <= 32;
    }
    for (std::size_t axes = 1; axes < allowed.size(); ++axes) {
      const uint64_t v = in.varint();
      sane = sane && v <= (1u << 20);
      allowed[axes] = static_cast<uint32_t>(v);
    }
    most = static_cast<int>(in.u8());
    const uint32_t select = in.u8();
    selective = select == 1;
    return sane && most <= 32 && select <= 1 && !in.malformed();
  }
};

/// All that both sides know, and the models that carry over from layer to layer.
struct Knowledge {
  explicit Knowledge(const Header& header) : signs(header.base()), level(0) {}

  template <class Exchange>
  void base(Exchange& ask) {
    BaseCoder<3>().tell(ask, signs);
  }

  template <class Exchange>
  void refine(Exchange& ask) {
    signs = refined(signs);
    ++level;
    for (int dimension = 3; dimension >= 1; --dimension) refinement.bisect(ask, signs, dimension);
  }

  template <class Exchange>
  void geometry(Exchange& ask, const GeometryPass& pass) {
    if (active.empty()) {
      active = activeBricks(signs);
      scalars = Scalars<3>(active.size());
    }
    if (pass.kind == LayerKind::Octaves) {
      told[static_cast<std::size_t>(pass.members)] = true;
      coder.tellOctaves(ask, signs, scalars, pass.members, pass.depth, active);
    } else {
      coder.refine(ask, signs, scalars, pass.members, pass.allowed, pass.most, pass.selective, active);
    }
  }

  Signs<3> signs;
  int level;
  RefinementCoder<3> refinement;
  std::vector<uint8_t> active;  // bricks of the finest octave; empty before the first geometry layer
  Scalars<3> scalars;
  std::array<bool, 2> told{};  // by Members: have their scalars been told, if perhaps not all of them?
  GeometryCoder<3> coder;
};

}  // namespace isostar
