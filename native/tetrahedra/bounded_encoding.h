#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tetrahedra/tetrahedral_field.h"
#include "volume/loaded_volume.h"

namespace isostar::native {

/// A stream of a tetrahedral mesh, and the two-sided distance of its surface from the isosurface of
/// the tetrahedra, in the mesh's unit.
struct BoundedStream {
  std::vector<std::byte> stream;
  LoadedVolume volume;  // the samples that the stream encodes
  double distance = 0;  // 0 if there is no surface
};

/// Encodes the isosurface of the tetrahedra within `bound`, in the mesh's unit (§1). The grid is
/// refined until sampling leaves a part of the bound to the codec, and each stream is measured. If
/// even 2^24 samples do not meet the bound, returns the closest stream with a remark. `options` is
/// as in encode() except for its bound; `progress` restarts with each grid. Throws a Failure naming
/// `path` if encode() fails.
BoundedStream encodeWithin(double bound, const TetrahedralField&, EncodeOptions options,
                           const std::string& path, const std::function<void(double)>& progress);

}  // namespace isostar::native
