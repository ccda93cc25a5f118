// A crossing edge as the source has it and as it is coded.
#pragma once

#include <algorithm>
#include <cmath>

namespace isostar {

/// Sizes of the scalars at both ends of an edge, without signs; coded and actual ones may have
/// different units.
struct CodedCrossing {
  double even, odd;              // as coded
  double actualEven, actualOdd;  // the samples'; at least one is not 0
  double length;                 // of the edge, grid steps

  /// How far the surface's vertex on the edge is from the source's, grid steps.
  [[nodiscard]] double distance() const {
    return length * std::abs(even / (even + odd) - actualEven / (actualEven + actualOdd));
  }
  /// Raises `most` to distance() if that is larger. Divides only if it is, or nearly.
  void raise(double& most) const {
    constexpr double kRounding = 1e-9;  // grid steps, more than any error of isWithin()
    if (!isWithin(most - kRounding)) most = std::max(most, distance());
  }
  /// distance() <= bound, without divisions.
  [[nodiscard]] bool isWithin(double bound) const {
    return length * std::abs(even * actualOdd - odd * actualEven) <=
           bound * (even + odd) * (actualEven + actualOdd);
  }
};

}  // namespace isostar
