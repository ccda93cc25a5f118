#pragma once

#include "isostar/isostar.h"

namespace isostar::measure {

/// The contours of an image extruded along z, from 0 to `width`. The distance between two ribbons
/// of one width is the distance between their contours.
Mesh ribbon(const Contours& contours, float width);

}  // namespace isostar::measure
