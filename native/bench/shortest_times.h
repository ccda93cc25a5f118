#pragma once

#include <functional>
#include <vector>

namespace isostar::bench {

/// The shortest time of each function in milliseconds. The functions take turns, so that a busy
/// machine affects all of them. At least three rounds, and more until about `milliseconds` have
/// passed.
std::vector<double> shortestTimes(const std::vector<std::function<void()>>& contenders,
                                  double milliseconds);

}  // namespace isostar::bench
