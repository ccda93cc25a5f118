// Streams whose every surface has the topology of the finest one (§4.3).
#pragma once

#include <vector>

#include "container/header.h"
#include "grid/signs.h"

namespace isostar {

/// The centres of cells that stay whole in a stream's first mesh, by octave: as TopologyPlan
/// allows, and such that what is shown of the mesh at each step, with signs estimated where it has
/// no vertices, can be turned into the source's surface vertex by vertex without a change in
/// topology, by `cubes` as well. `truth` are the source's signs by octave.
[[nodiscard]] std::vector<Signs<3>> wholeCells(const Header& header,
                                               const std::vector<Signs<3>>& actual);

}  // namespace isostar
