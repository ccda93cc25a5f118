#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isostar/isostar.h"
#include "measure/triangle_tree.h"

namespace isostar::bench {

struct SingleRateStream {
  std::vector<std::byte> bytes;
  size_t connectivity = 0;          // of its bytes: levels, signs and where components begin
  size_t leaves = 0, vertices = 0;  // of the tube
};

/// A surface at a single rate, for comparison only (§5.1, §6): a mesh of the RBMT that is adapted
/// to a distance, told through its gates, then the scalars of its vertices. One stream for each
/// bound, in grid steps and to first order: who wants to know measures. `surface` is the source's,
/// in grid steps.
[[nodiscard]] std::vector<SingleRateStream> encodeSingleRate(const Volume& volume, double isovalue,
                                                             const measure::TriangleTree& surface,
                                                             std::span<const double> bounds);

/// Samples of the piecewise linear function that a stream tells, 0 on the surface, x fastest.
struct SampledFunction {
  std::vector<float> samples;
  std::array<int32_t, 3> size{};
};
[[nodiscard]] SampledFunction decodeSingleRate(std::span<const std::byte>);

}  // namespace isostar::bench
