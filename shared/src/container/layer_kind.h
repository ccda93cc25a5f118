// The kinds of layers, and the properties of each kind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace isostar {

/// Stored in three bits of a layer's head, so that every value is a kind.
enum class LayerKind : uint8_t {
  Base = 0,
  Refinement = 1,
  Exponents = 2,
  Magnitudes = 3,
  Domain = 4,
  Displacement = 5,
  FurtherSigns = 6,
  FurtherGeometry = 7
};

/// From which part of its bytes on a torn layer is shown. With less it is no better than the layer
/// before it.
enum class TornFrom : uint8_t { Never, Quarter, FirstByte };

struct LayerTraits {
  const char* name;  // reported as LayerInfo::kind
  bool hasPass;      // begins with the fields of a GeometryPass
  bool isFurther;    // belongs to a further isovalue; the head holds that isovalue's number instead
                     // of a level
  TornFrom tornFrom;  // in a uniform stream
};

inline constexpr std::array<LayerTraits, 8> kLayerTraits{{
    /* Base */ {"base", false, false, TornFrom::Never},
    /* Refinement */ {"refinement", false, false, TornFrom::Quarter},
    /* Exponents */ {"geometry", true, false, TornFrom::Quarter},
    /* Magnitudes */ {"geometry", true, false, TornFrom::FirstByte},
    /* Domain */ {"domain", false, false, TornFrom::Never},
    /* Displacement */ {"geometry", true, false, TornFrom::FirstByte},
    /* FurtherSigns */ {"refinement", false, true, TornFrom::Never},
    /* FurtherGeometry */ {"geometry", true, true, TornFrom::FirstByte},
}};

[[nodiscard]] constexpr const LayerTraits& traitsOf(LayerKind kind) {
  return kLayerTraits[static_cast<std::size_t>(kind)];
}

}  // namespace isostar
