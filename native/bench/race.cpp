#include "bench/race.h"

#include <algorithm>
#include <limits>

#include "cli/work_report.h"

namespace isostar::bench {

std::vector<double> race(const std::vector<std::function<void()>>& contenders,
                         double milliseconds) {
  constexpr int kFewest = 3, kMost = 200;
  std::vector<double> best(contenders.size(), std::numeric_limits<double>::infinity());
  const native::Stopwatch whole;
  for (int round = 0; round < kFewest || (round < kMost && whole.milliseconds() < milliseconds);
       ++round) {
    for (size_t i = 0; i < contenders.size(); ++i) {
      const native::Stopwatch lap;
      contenders[i]();
      best[i] = std::min(best[i], lap.milliseconds());
    }
  }
  return best;
}

}  // namespace isostar::bench
