// The bytes of a layer, as a reconstruction reads them: the fields of its pass, then the coded
// bits.
#pragma once

#include <optional>

#include "coding/geometry/geometry_pass.h"
#include "decoder/reconstruction.h"

namespace isostar {

template <int D>
struct LayerInput {
  /// How many bytes a range decoder may read beyond the end of a complete layer: four that the
  /// encoder may omit, and four that the decoder reads ahead.
  static constexpr std::size_t kSlack = 8;

  GeometryPass<D> pass;
  std::span<const std::byte> coded;

  /// Reads the fields. Returns an outcome only if decoding stops here: the fields are corrupt, or
  /// the layer is torn within them.
  [[nodiscard]] std::optional<Reconstruction::Outcome> read(LayerKind kind,
                                                            std::span<const std::byte> bytes,
                                                            bool torn) {
    using Outcome = Reconstruction::Outcome;
    pass.kind = kind;
    coded = bytes;
    if (!traitsOf(kind).hasPass) return std::nullopt;
    ByteReader fields(bytes);
    if (kind == LayerKind::FurtherGeometry) {
      pass.kind = static_cast<LayerKind>(fields.u8());
      if (!fields.overrun() && pass.kind != LayerKind::Exponents &&
          pass.kind != LayerKind::Magnitudes)
        return Outcome{Error::Corrupt};
    }
    if (!pass.read(fields)) return Outcome{Error::Corrupt};
    if (fields.overrun()) return Outcome{torn ? Error::None : Error::Corrupt};
    coded = bytes.subspan(fields.position());
    return std::nullopt;
  }
};

}  // namespace isostar
