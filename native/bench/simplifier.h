#pragma once

#include "isostar/isostar.h"

namespace isostar::bench {

/// meshoptimizer's simplifier, as far down to `ratio` of the triangles as it goes.
Mesh simplified(const Mesh&, double ratio);

}  // namespace isostar::bench
