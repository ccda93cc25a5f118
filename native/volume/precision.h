#pragma once

#include <vector>

namespace isostar::native {

/// How far, in grid steps, the rounding of samples moves the surface: half of what they are whole
/// numbers of (1, 1/255, else the last bit of the largest), over the mean difference between
/// neighbours on the two sides of the isovalue. 0 where no neighbours along the first axis are on
/// both sides.
double precisionOf(const std::vector<float>& samples, int samplesAlongFirstAxis, double isovalue);

}  // namespace isostar::native
