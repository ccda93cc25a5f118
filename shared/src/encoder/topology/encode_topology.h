// Streams that preserve the topology: each surface they show has that of the finest one (§4.3).
#pragma once

#include <vector>

#include "container/header.h"
#include "grid/signs.h"

namespace isostar {

/// The centres of the cells that a stream's first mesh keeps, as TopologyPlan::centres() has them.
/// They are chosen as TopologyPlan allows. In addition, the shown surface of each step, with signs
/// estimated at absent vertices, can be turned into the source's surface by flips of single
/// vertices that preserve the topology of Polygonizer::Cubes. `actual`: the source's signs by
/// level.
[[nodiscard]] std::vector<Signs<3>> wholeCells(const Header& header,
                                               const std::vector<Signs<3>>& actual);

}  // namespace isostar
