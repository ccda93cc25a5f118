#pragma once

#include <functional>
#include <optional>

#include "measure/surface_distance.h"
#include "tetrahedra/tetrahedral_field.h"
#include "volume/loaded_volume.h"
#include "volume/sample_grid.h"

namespace isostar::native {

/// Tetrahedra sampled as a volume, and the distance of its marching cubes surface from the
/// isosurface of the tetrahedra (§1), in the mesh's unit; nothing if either has no triangle.
struct TetrahedraVolume {
  LoadedVolume volume;  // with the remarks of the mesh
  std::optional<measure::SurfaceDistance> distance;
};

/// The meaning of samples: the field, which has all isosurfaces, or distances to one isosurface,
/// which are more accurate and take fewer bytes (see replaceByDistances()).
enum class Scalars : uint8_t { Field, Distances };

/// `isosurface` is isosurfaceOf(field.mesh(), isovalue).
TetrahedraVolume volumeOf(const TetrahedralField&, const Mesh& isosurface, double isovalue, Scalars,
                          const SampleGrid&, const std::function<void(double)>& progress);

}  // namespace isostar::native
