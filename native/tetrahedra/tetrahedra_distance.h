#pragma once

#include <optional>

#include "measure/surface_distance.h"
#include "tetrahedra/tetrahedral_field.h"

namespace isostar::native {

/// The distance from a surface to the isosurface of the tetrahedra (aToB) and back (bToA). aToB
/// ignores the parts of the surface beyond the domain; bToA includes them. Nothing if either has no
/// triangle within the domain.
std::optional<measure::SurfaceDistance> distanceToTetrahedra(const Mesh& surface,
                                                             const TetrahedralField&,
                                                             const Mesh& isosurface);

}  // namespace isostar::native
