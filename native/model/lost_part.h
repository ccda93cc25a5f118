#pragma once

#include <vector>

#include "isostar/isostar.h"
#include "model/cubic_grid.h"

namespace isostar::native {

/// The part of the surface's area, 0 … 1, near which no two samples differ in sign: thinner than
/// the grid shows. Judged by the middles of the triangles.
double lostPart(const Mesh&, const CubicGrid&, const std::vector<float>& samples);

}  // namespace isostar::native
