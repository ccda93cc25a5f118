#pragma once

#include "isostar/isostar.h"
#include "tetrahedra/tetrahedral_field.h"

namespace isostar::native {

/// The part of a surface inside the domain. Triangles that cross the boundary are cut where the
/// distance to it, interpolated linearly along their edges, is 0.
Mesh trimToDomain(const Mesh&, const TetrahedralField&);

}  // namespace isostar::native
