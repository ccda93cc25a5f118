// From the signs and scalars of an image to polylines (§3, §6); independent of streams.
#pragma once

#include "isostar/isostar.h"
#include "surface/surface.h"

namespace isostar {

/// Traces the isocontours; options.frame and options.polygonizer apply. OverLimit, and empty
/// contours, if they have more points than limits.vertices or tracing takes more bytes than
/// limits.memory.
[[nodiscard]] Error polygonize(const Surface<2>&, const MeshOptions&, const Limits&, Contours& out);

}  // namespace isostar
