// From known signs and scalars of an image to polylines (§3, §6). It has no idea that a stream exists.
#pragma once

#include "isostar/isostar.h"
#include "surface.h"

namespace isostar {

/// OverLimit where the contours would have more points than allowed.
[[nodiscard]] Error polygonize(const Surface<2>&, const MeshOptions&, uint64_t mostVertices, Contours& out);

}  // namespace isostar
