#include "bench/otsu.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace isostar::bench {
namespace {

constexpr double kMostBins = 65536;

}  // namespace

double otsuThreshold(const std::vector<float>& samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  const bool whole =
      std::all_of(samples.begin(), samples.end(), [](float s) { return s == std::floor(s); });
  const double range = double{*high} - *low, start = *low;
  const double width =
      whole ? std::max(1.0, std::ceil((range + 1) / kMostBins)) : std::max(range / 4096, 1e-30);
  std::vector<uint64_t> bins(static_cast<size_t>(range / width) + 1);
  for (float s : samples) ++bins[static_cast<size_t>((s - start) / width)];

  double all = 0;
  for (size_t b = 0; b < bins.size(); ++b)
    all += static_cast<double>(b) * static_cast<double>(bins[b]);
  const double count = static_cast<double>(samples.size());
  double below = 0, sumBelow = 0, best = -1;
  size_t last = 0;  // the bin below the threshold
  for (size_t b = 0; b + 1 < bins.size(); ++b) {
    below += static_cast<double>(bins[b]);
    sumBelow += static_cast<double>(b) * static_cast<double>(bins[b]);
    if (below == 0 || below == count) continue;
    const double means = sumBelow / below - (all - sumBelow) / (count - below);
    const double between = below * (count - below) * means * means;
    if (between > best) best = between, last = b;
  }
  return start + width * static_cast<double>(last + 1) - (whole ? 0.5 : 0);
}

}  // namespace isostar::bench
