#pragma once

#include "isostar/isostar.h"
#include "tetrahedra/tetrahedral_field.h"

namespace isostar::native {

/// A surface without what lies beyond the domain: triangles across the boundary are cut where the
/// distance to it, linear along their edges, is 0.
Mesh trimmed(const Mesh&, const TetrahedralField&);

}  // namespace isostar::native
