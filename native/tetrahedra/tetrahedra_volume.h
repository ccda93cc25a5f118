#pragma once

#include <functional>
#include <optional>

#include "measure/surface_distance.h"
#include "tetrahedra/sample_grid.h"
#include "tetrahedra/tetrahedral_field.h"
#include "volume/loaded_volume.h"

namespace isostar::native {

/// Tetrahedra as a volume, and how far marching cubes' surface of it is from their own isosurface
/// (§1), in the mesh's unit; nothing where either has no triangle.
struct TetrahedraVolume {
  LoadedVolume volume;  // its remarks are the mesh's
  std::optional<measure::SurfaceDistance> distance;
};

/// What samples tell: the field, at all isovalues, or one isosurface alone, better and in fewer
/// bytes (see becomeDistances).
enum class Scalars : uint8_t { Field, Distances };

/// `isosurface` is isosurfaceOf() the mesh.
TetrahedraVolume volumeOf(const TetrahedralField&, const Mesh& isosurface, double isovalue, Scalars,
                          const SampleGrid&, const std::function<void(double)>& progress);

}  // namespace isostar::native
