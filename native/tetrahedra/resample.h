#pragma once

#include <functional>
#include <optional>
#include <string>

#include "model/cubic_grid.h"
#include "tetrahedra/tetrahedral_field.h"

namespace isostar::native {

/// A grid of cubes over the mesh's bounding box, `samples` along its longest side; without a number, as many as give
/// two steps to the typical edge that the isosurface crosses, but at most 513. Fails with one line naming `path` where
/// the codec cannot hold it.
CubicGrid gridOver(const TetrahedralField&, double isovalue, std::optional<int> samples, const std::string& path);

/// A tetrahedral field on a grid (x fastest), and where it ends.
struct ResampledField {
  std::vector<float> samples;  // beyond the domain they go on: see TetrahedralField::beyond()
  std::vector<float> domain;  // distance to the domain's boundary in grid steps, positive inside, at most ±kDomainBand
};

inline constexpr float kDomainBand = 4;

/// `progress` is called now and then with 0 … 1, by any thread, one at a time.
ResampledField resample(const TetrahedralField&, const CubicGrid&, const std::function<void(double)>& progress);

}  // namespace isostar::native
