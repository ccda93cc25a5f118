// Flips of vertices' signs, one after the other, that preserve the topology of the surface of
// Polygonizer::Cubes.
#pragma once

#include <vector>

#include "grid/signs.h"

namespace isostar {

/// May a vertex of the finest level change its sign, such that the surface in the cells around it
/// only deforms and stays the same outside of them? This holds if the pieces of the surface there
/// have the same Euler characteristic and connect the same vertices on outer edges before and
/// after, and no piece is closed. At the end of the box the same must hold for the curves on its
/// faces.
[[nodiscard]] bool flipKeepsTopology(const Signs<3>& signs, const Coordinates<3>& v);

/// Flips the vertices in which two sets of signs differ, in any order, as long as each flip
/// preserves the topology. Returns the vertices that are left. If there are none, both surfaces
/// have the same topology.
[[nodiscard]] std::vector<Coordinates<3>> stuckFlips(Signs<3> from, const Signs<3>& to);

}  // namespace isostar
