#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isostar/isostar.h"
#include "measure/triangle_tree.h"

namespace isostar::bench {

struct SingleRateStream {
  std::vector<std::byte> bytes;
  size_t connectivity = 0;          // bytes of depths, signs and localizations
  size_t leaves = 0, vertices = 0;  // of the tube
};

/// Encodes a surface at a single rate, for comparison only (§5.1, §6): an RBMT adapted to a
/// distance, coded by gate traversal, then the scalars of its vertices. One stream for each bound,
/// in grid steps; the bound holds only to first order, so distances must be measured. `surface` is
/// the source's, in grid steps.
[[nodiscard]] std::vector<SingleRateStream> encodeSingleRate(const Volume& volume, double isovalue,
                                                             const measure::TriangleTree& surface,
                                                             std::span<const double> bounds);

/// Samples of a stream's piecewise linear function, which is 0 on the surface; x fastest.
struct SampledFunction {
  std::vector<float> samples;
  std::array<int32_t, 3> size{};
};
[[nodiscard]] SampledFunction decodeSingleRate(std::span<const std::byte>);
/// Its surface in grid steps, to the precision of a stream: the samples at the ends of an edge may
/// both be the rounding of larger ones, which polygonize() refuses.
[[nodiscard]] Mesh surfaceOf(const SampledFunction&);

}  // namespace isostar::bench
