// A sequence's surface at a time: a volume's signs and scalars, cut out of those in four dimensions
// (§6).
#pragma once

#include "surface/surface.h"

namespace isostar {

/// Scalars count half quanta · 2^-finer, with offsets of their own.
struct TimeSlice {
  Signs<3> signs;
  Scalars<3> scalars;
  double positiveOffset = 0, negativeOffset = 0;
};

/// On a plane of the lattice: what is known there. Between two planes scalars are interpolated;
/// where only one of two is known, both have the same sign, and it stands for the other.
[[nodiscard]] TimeSlice sliceAt(const Surface<4>& surface, double time);

/// Bytes that a slice takes at most, at any time.
[[nodiscard]] uint64_t memoryToSlice(const Surface<4>& surface);

}  // namespace isostar
