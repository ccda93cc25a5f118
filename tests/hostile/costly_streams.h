// Streams that cost a decoder much for their bytes, as recipes.
#pragma once

#include <string>

#include "container/index.h"
#include "grid/tube.h"
#include "property/round_trip.h"

namespace isostar {

/// A GeometryPass, whatever the dimension. `diagonals`: edges along several axes count, too.
struct CostlyPass {
  LayerKind kind = LayerKind::Exponents;
  Members members = Members::AxisEnds;
  int range = 2, most = 30;
  uint32_t allowed = 1;
  bool diagonals = false, selective = false;
};

/// A recipe for a stream. `noisy` and `surprise` are those of ExpectedCoder, for layers of signs
/// and for others. `passes` and `furtherPasses` are repeated `repeats` times, or until there are
/// kMostLayers.
struct CostlyStream {
  std::string name;
  Header header;
  uint64_t seed = 1;
  uint64_t noisy = 40, noisyGeometry = 40;
  double surprise = 0, surpriseGeometry = 0;
  std::vector<CostlyPass> passes, furtherPasses;
  int repeats = kMostLayers;
};

/// The bytes of a stream. It ends with the layer that exceeds the limits.
[[nodiscard]] Bytes assembled(const CostlyStream& recipe, const Limits& limits);

}  // namespace isostar
