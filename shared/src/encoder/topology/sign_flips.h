// Does the surface that `cubes` makes keep its topology where vertices change their signs one after
// the other?
#pragma once

#include <vector>

#include "grid/signs.h"

namespace isostar {

/// May a vertex of the finest octave change its sign so that the surface in the cells around it
/// stays the same but for a deformation that leaves those cells' outside alone? So it is if the
/// pieces there have the same Euler characteristic and join the same of the outer edges' vertices
/// before and after, and no piece is closed; where the box ends this holds for the curves on its
/// faces, too.
[[nodiscard]] bool flipKeepsTopology(const Signs<3>& signs, const Coordinates<3>& v);

/// Turns the vertices in which two sets of signs differ as far as each turn keeps the topology, in
/// any order; which are left? None: both surfaces have the same topology.
[[nodiscard]] std::vector<Coordinates<3>> stuckFlips(Signs<3> from, const Signs<3>& to);

}  // namespace isostar
