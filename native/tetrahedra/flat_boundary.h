#pragma once

#include <array>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::native {

/// Where a domain's boundary lies across an axis, and how much of it, as a part of its whole area.
struct FlatPart {
  double place = 0, share = 0;
};

/// Of each axis, by growing place: floors and walls of a room, say.
std::array<std::vector<FlatPart>, 3> flatParts(const Mesh& boundary);

}  // namespace isostar::native
