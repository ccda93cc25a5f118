#include "tetrahedra/tetrahedra_distance.h"

#include "tetrahedra/trimmed_surface.h"

namespace isostar::native {

std::optional<measure::SurfaceDistance> distanceToTetrahedra(const Mesh& surface,
                                                             const TetrahedralField& field,
                                                             const Mesh& isosurface) {
  const auto there = measure::surfaceDistance(trimToDomain(surface, field), isosurface);
  const auto back = measure::surfaceDistance(isosurface, surface);
  if (!there || !back) return {};
  return measure::SurfaceDistance{there->aToB, back->aToB};
}

}  // namespace isostar::native
