#pragma once

#include <optional>
#include <string>

#include "tetrahedra/tetrahedra_volume.h"
#include "volume/volume_reader.h"

namespace isostar::native {

/// The command line's description of the input of `encode`.
struct SourceRequest {
  VolumeRequest volume;
  std::optional<int> grid{};  // samples along the longest axis, for meshes
  std::optional<double> isovalue{};
  Scalars scalars = Scalars::Distances;  // of tetrahedra
};

/// Throws a UsageFault on options that do not fit together or to the source: a raw volume's size
/// without its type, --grid for a volume, no --iso.
void requireConsistent(const SourceRequest&);

/// The requested isovalue, or 0, where the surface of a closed mesh is.
double isovalueOf(const SourceRequest&);

/// Whether the file is a tetrahedral mesh.
bool hasTetrahedra(const SourceRequest&);

/// The function on a tetrahedral mesh. Throws a Failure.
TetrahedralField readTetrahedralField(const SourceRequest&);

/// The source as samples on a grid, with a progress bar while a mesh is sampled. Throws a Failure.
LoadedVolume readSource(const SourceRequest&);

}  // namespace isostar::native
