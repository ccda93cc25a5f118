// The oracle of bounds: where the samples themselves cross the isovalue, in double precision. It
// knows nothing of quantization steps.
#pragma once

#include <algorithm>
#include <cmath>

#include "round_trip.h"

namespace isostar {

/// Where on its edge (0 … 1 from the lower sample) the samples cross the isovalue.
inline double exactCrossing(const SampledField& field, double isovalue,
                            const std::array<int, 3>& low, std::size_t axis) {
  const auto& n = field.size;
  const auto sample = [&](std::array<int, 3> v, int along) {
    v[axis] += along;
    return double{field.samples[static_cast<std::size_t>((v[2] * n[1] + v[1]) * n[0] + v[0])]} -
           isovalue;
  };
  return sample(low, 0) / (sample(low, 0) - sample(low, 1));
}

/// The largest distance, in samples, between a vertex of what `cubes` makes (in the grid's frame)
/// and the exact crossing of its edge; infinite if the meshes do not match.
inline double farthestFromExact(const Mesh& mesh, const SampledField& field, double isovalue = 0) {
  // A field of the same signs has the same vertices in the same order, all in the middle of edges.
  SampledField signs = field;
  for (float& s : signs.samples) s = double{s} > isovalue ? 1.F : -1.F;
  const Mesh middles = sourceMesh(signs, {Polygonizer::Cubes, Frame::Grid, false});
  if (mesh.indices != middles.indices) return INFINITY;
  double farthest = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    std::array<int, 3> low{};
    std::size_t axis = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const float middle = middles.positions[i + a];
      low[a] = static_cast<int>(middle);
      if (middle != std::floor(middle)) axis = a;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      const double exact = low[a] + (a == axis ? exactCrossing(field, isovalue, low, axis) : 0);
      farthest = std::max(farthest, std::abs(mesh.positions[i + a] - exact));
    }
  }
  return farthest;
}

}  // namespace isostar
