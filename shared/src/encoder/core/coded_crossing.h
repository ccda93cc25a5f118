// A crossing edge as the source has it and as it is coded.
#pragma once

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
  /// distance() <= bound, without divisions.
  [[nodiscard]] bool isWithin(double bound) const {
    return length * std::abs(even * actualOdd - odd * actualEven) <=
           bound * (even + odd) * (actualEven + actualOdd);
  }
};

}  // namespace isostar
