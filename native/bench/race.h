#pragma once

#include <functional>
#include <vector>

namespace isostar::bench {

/// The shortest time of each contender in milliseconds. They take turns, so that a busy moment hits
/// all of them; at least three rounds, more for about as long as `milliseconds`.
std::vector<double> race(const std::vector<std::function<void()>>& contenders, double milliseconds);

}  // namespace isostar::bench
