#pragma once

#include <span>

#include "tetrahedra/tetrahedral_field.h"
#include "volume/sample_grid.h"

namespace isostar::native {

/// Points within this many grid steps of the boundary count as on it: a stream's distances have no
/// finer resolution.
inline constexpr double kOnBoundary = 1.0 / 64;

/// A domain's boundary without the faces on the sides of the grid, where every surface ends anyway.
Mesh innerBoundary(const SampleGrid&, const Mesh& boundary);

/// A gap in the domain that is one step wide, between two faces on adjacent planes of the grid,
/// contains no samples. The samples on its faces are marked as outside, or the surface would
/// continue across the gap. `domain` is ResampledField::domain.
void openThinGaps(const TetrahedralField&, const SampleGrid&, std::span<float> domain);

}  // namespace isostar::native
