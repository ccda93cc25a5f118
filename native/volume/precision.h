#pragma once

#include <vector>

namespace isostar::native {

/// How far the rounding of samples moves the surface, in grid steps: half the unit in which the
/// samples are whole numbers (1, 1/255, else the last bit of the largest sample), divided by the
/// mean difference of neighbours on either side of the isovalue. 0 if no edge along the first axis
/// crosses.
double precisionOf(const std::vector<float>& samples, int samplesAlongFirstAxis, double isovalue);

}  // namespace isostar::native
