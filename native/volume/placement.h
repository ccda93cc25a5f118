#pragma once

#include <array>
#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// The step in the world along each index axis.
using AxisSteps = std::array<std::array<double, 3>, 3>;

/// The length of each step becomes the spacing, its direction the direction: any affine map is
/// preserved. Throws a Failure naming `file` if the map is not invertible.
Placement placementOf(const std::string& file, const std::array<double, 3>& origin,
                      const AxisSteps& steps);

/// The largest deviation of two axes from a right angle, in degrees; 0 for an orthogonal grid.
double shearDegrees(const Placement&);

/// The length of the shortest step, in which lengths in grid steps are measured.
double smallestSpacing(const Placement&);

}  // namespace isostar::native
