// The parameters of a geometry layer's pass: the fields at the layer's beginning.
#pragma once

#include "coding/geometry/magnitude_coder.h"
#include "container/stream.h"
#include "scalars/displacements.h"
#include "util/cold_path.h"

namespace isostar {

/// A pass over displacements or scalars, as decided by the encoder.
template <int D>
struct GeometryPass {
  using Allowed = typename MagnitudeCoder<D>::Allowed;

  LayerKind kind = LayerKind::Exponents;
  Members members = Members::AxisEnds;
  int exponentRange = 3;            // Exponents: how many bits the floor lies below the gradient
  Allowed allowed{};                // Magnitudes: how far a crossing may move, as in FarEnds
  int most = 1;                     // Magnitudes: refinements of one interval at most
  bool selective = false;           // Magnitudes: codes for each brick whether it takes part
  DisplacementPass displacement{};  // Displacement: cubes and steps

  /// The parameters of MagnitudeCoder. `fitted`: a property of the whole stream.
  [[nodiscard]] typename MagnitudeCoder<D>::Pass magnitudePass(bool fitted) const {
    return {.members = members,
            .allowed = allowed,
            .most = most,
            .selective = selective,
            .fitted = fitted};
  }

  void write(ByteWriter& out) const {
    if (kind == LayerKind::Displacement) {
      out.u8(static_cast<uint64_t>(displacement.log2Side) | static_cast<uint64_t>(displacement.step)
                                                                << 2);
      return;
    }
    if (kind == LayerKind::Exponents) {
      out.u8(static_cast<uint64_t>(members) | static_cast<uint64_t>(exponentRange) << 1);
      return;
    }
    out.u8(static_cast<uint64_t>(members) | (selective ? 2u : 0u) |
           static_cast<uint64_t>(most) << 2);
    // If the same on all axes, and 0 on diagonals, one number is enough.
    const bool even = allowed == alike(allowed[1]);
    out.varint(uint64_t{allowed[1]} << 1 | (even ? 1u : 0u));
    for (std::size_t axes = 2; !even && axes < allowed.size(); ++axes) out.varint(allowed[axes]);
  }
  /// False if a field is out of range.
  [[nodiscard]] ISOSTAR_COLD bool read(ByteReader& in) {
    const uint32_t first = in.u8();
    if (kind == LayerKind::Displacement) {
      displacement = {static_cast<int>(first & 3), static_cast<int>(first >> 2)};
      return in.overrun() || (displacement.log2Side > 0 && displacement.step > 0);
    }
    members = static_cast<Members>(first & 1);
    if (kind == LayerKind::Exponents) {
      exponentRange = static_cast<int>(first >> 1);
      return exponentRange <= 32;
    }
    selective = (first & 2) != 0;
    most = static_cast<int>(first >> 2);
    uint64_t v = in.varint();
    const bool even = (v & 1) != 0;
    v >>= 1;
    bool sane = most <= 32 && v <= kMostAllowed;
    allowed = alike(static_cast<uint32_t>(v));
    for (std::size_t axes = 2; !even && axes < allowed.size(); ++axes) {
      v = in.varint();
      sane = sane && v <= kMostAllowed;
      allowed[axes] = static_cast<uint32_t>(v);
    }
    return sane && !in.malformed();
  }

 private:
  static constexpr uint64_t kMostAllowed = 1u << 20;
  static Allowed alike(uint32_t onAxes) {
    Allowed allowed{};
    for (int a = 0; a < D; ++a) allowed[std::size_t{1} << a] = onAxes;
    return allowed;
  }
};

}  // namespace isostar
