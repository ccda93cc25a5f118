// From known signs and scalars of an image to polylines (§3, §6). It has no idea that a stream
// exists.
#pragma once

#include "isostar/isostar.h"
#include "surface/surface.h"

namespace isostar {

/// OverLimit, and no contours, where they would have more points than allowed, or where it takes
/// more memory to trace them.
[[nodiscard]] Error polygonize(const Surface<2>&, const MeshOptions&, const Limits&, Contours& out);

}  // namespace isostar
