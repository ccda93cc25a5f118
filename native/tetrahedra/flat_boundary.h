#pragma once

#include <array>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::native {

/// A part of a domain's boundary that is perpendicular to an axis: its coordinate on that axis, and
/// its share of the boundary's area.
struct FlatPart {
  double coordinate = 0, share = 0;
};

/// The flat parts perpendicular to each axis, by increasing coordinate: floors and walls of a room,
/// for example.
std::array<std::vector<FlatPart>, 3> flatParts(const Mesh& boundary);

}  // namespace isostar::native
