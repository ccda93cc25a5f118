#pragma once

#include <optional>

#include "measure/surface_distance.h"
#include "tetrahedra/tetrahedral_field.h"

namespace isostar::native {

/// From a surface to the isosurface of the tetrahedra (aToB) and back (bToA). What of the surface
/// lies beyond the domain has no distance; on the way back all of it counts. Nothing where either
/// has no triangle within the domain.
std::optional<measure::SurfaceDistance> distanceToTetrahedra(const Mesh& surface,
                                                             const TetrahedralField&,
                                                             const Mesh& isosurface);

}  // namespace isostar::native
