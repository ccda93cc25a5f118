#pragma once

#include <span>

#include "tetrahedra/sample_grid.h"
#include "tetrahedra/tetrahedral_field.h"

namespace isostar::native {

/// So many grid steps from the boundary are on it: a stream's distances are no finer.
inline constexpr double kOnBoundary = 1.0 / 64;

/// Where a domain ends within the grid: its boundary without the faces at the grid's own ends,
/// beyond which no surface goes.
Mesh boundaryWithin(const SampleGrid&, const Mesh& boundary);

/// Air one step thick between two faces of the domain, on planes of the grid, has no sample of its
/// own: those on the faces go to it, else the surface would go on from one to the other. `domain`
/// is ResampledField's.
void seeThinAir(const TetrahedralField&, const SampleGrid&, std::span<float> domain);

}  // namespace isostar::native
