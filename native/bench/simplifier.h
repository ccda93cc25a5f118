#pragma once

#include "isostar/isostar.h"

namespace isostar::bench {

/// The mesh after meshoptimizer's simplifier, with `ratio` of the triangles or as close to that as
/// it gets.
Mesh simplified(const Mesh&, double ratio);

}  // namespace isostar::bench
