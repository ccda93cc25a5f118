#pragma once

#include <vector>

namespace isostar::bench {

/// The threshold that splits the samples into the two classes least spread within themselves. It
/// lies between two whole numbers where all samples are whole.
double otsuThreshold(const std::vector<float>& samples);

}  // namespace isostar::bench
