#pragma once

#include <array>
#include <string>

#include "isostar/isostar.h"

namespace isostar::native {

/// A world step along each index axis.
using AxisSteps = std::array<std::array<double, 3>, 3>;

/// Spacing is the length of each step, direction the rest; whatever the affine was, it is kept.
/// Fails with one line naming `file` where it cannot be inverted.
Placement placementOf(const std::string& file, const std::array<double, 3>& origin,
                      const AxisSteps& steps);

/// How far the axes are from a right angle, in degrees; 0 for an orthogonal grid.
double shearDegrees(const Placement&);

/// The length of the shortest step: the unit of lengths given in grid steps.
double smallestSpacing(const Placement&);

}  // namespace isostar::native
