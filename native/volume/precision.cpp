#include "volume/precision.h"

#include <algorithm>
#include <cmath>

namespace isostar::native {
namespace {

bool allWhole(const std::vector<float>& samples, double scale) {
  constexpr double kRounding = 1e-4;
  return std::all_of(samples.begin(), samples.end(), [scale](float v) {
    const double scaled = v * scale;
    return std::abs(scaled - std::round(scaled)) <= kRounding;
  });
}

double unitOf(const std::vector<float>& samples) {
  for (const double steps : {1.0, 255.0}) {
    if (allWhole(samples, steps)) return 1 / steps;
  }
  float largest = 0;
  for (const float v : samples) largest = std::max(largest, std::abs(v));
  return std::nextafter(largest, INFINITY) - largest;
}

}  // namespace

double precisionOf(const std::vector<float>& samples, int samplesAlongFirstAxis, double isovalue) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 1; i < samples.size(); ++i) {
    if (i % static_cast<size_t>(samplesAlongFirstAxis) == 0) continue;
    if ((samples[i] > isovalue) == (samples[i - 1] > isovalue)) continue;
    sum += std::abs(double{samples[i]} - samples[i - 1]);
    ++count;
  }
  return count == 0 ? 0 : 0.5 * unitOf(samples) * static_cast<double>(count) / sum;
}

}  // namespace isostar::native
