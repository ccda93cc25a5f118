#pragma once

#include <optional>
#include <string>

#include "tetrahedra/tetrahedra_volume.h"
#include "volume/read_volume.h"

namespace isostar::native {

/// What `encode` is told of its input.
struct SourceRequest {
  VolumeRequest volume;
  std::optional<int>
      grid{};  // samples along the longest axis; for meshes, which have no grid of their own
  std::optional<std::string> scalar{};  // which one of a tetrahedral mesh
  std::optional<double> isovalue{};
  Scalars scalars = Scalars::Distances;  // of tetrahedra
};

/// Refuses what does not go together: a raw volume's size without its type, --grid for what has a
/// grid, no --iso.
void requireSense(const SourceRequest&);

/// The isovalue asked for; for a closed mesh it need not be, its surface is at 0.
double isovalueOf(const SourceRequest&);

/// Whether the file is a tetrahedral mesh.
bool hasTetrahedra(const SourceRequest&);

/// Its function. Fails with one line.
TetrahedralField readTetrahedralField(const SourceRequest&);

/// The file as samples on a grid, with a progress bar where these must be made first. Fails with
/// one line.
LoadedVolume readSource(const SourceRequest&);

}  // namespace isostar::native
