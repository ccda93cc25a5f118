#pragma once

#include <vector>

namespace isostar::bench {

/// Otsu's threshold, which splits the samples into two classes with the least variance within the
/// classes. It is halfway between two whole numbers if all samples are whole.
double otsuThreshold(const std::vector<float>& samples);

}  // namespace isostar::bench
