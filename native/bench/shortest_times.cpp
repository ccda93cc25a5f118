#include "bench/shortest_times.h"

#include <algorithm>
#include <limits>

#include "cli/stopwatch.h"

namespace isostar::bench {

std::vector<double> shortestTimes(const std::vector<std::function<void()>>& functions,
                                  double milliseconds) {
  constexpr int kFewest = 3, kMost = 200;
  std::vector<double> best(functions.size(), std::numeric_limits<double>::infinity());
  const native::Stopwatch whole;
  for (int round = 0; round < kFewest || (round < kMost && whole.milliseconds() < milliseconds);
       ++round) {
    for (size_t i = 0; i < functions.size(); ++i) {
      const native::Stopwatch lap;
      functions[i]();
      best[i] = std::min(best[i], lap.milliseconds());
    }
  }
  return best;
}

}  // namespace isostar::bench
