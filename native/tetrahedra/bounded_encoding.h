#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tetrahedra/tetrahedral_field.h"
#include "volume/loaded_volume.h"

namespace isostar::native {

/// A stream of tetrahedra, and how far its surface is from their own isosurface, both ways, in the
/// mesh's unit.
struct BoundedStream {
  std::vector<std::byte> stream;
  LoadedVolume volume;  // of which the stream was made
  double distance = 0;  // 0 where there is no surface
};

/// Tells the isosurface of the tetrahedra themselves within `bound`, in the mesh's unit (§1): the
/// grid gets finer until its samples leave the codec a part of the bound, and each stream is
/// measured. Where even 2^24 samples do not hold the bound, the nearest stream comes with a remark.
/// `options` counts as in encode(), but for its bound; `progress` starts again with each grid.
/// Fails with one line naming `path` where encode() does.
BoundedStream encodeWithin(double bound, const TetrahedralField&, EncodeOptions options,
                           const std::string& path, const std::function<void(double)>& progress);

}  // namespace isostar::native
