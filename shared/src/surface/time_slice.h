// A sequence's surface at one time: the signs and scalars of a volume, cut out of those in four
// dimensions (§6).
#pragma once

#include "surface/surface.h"

namespace isostar {

/// Between two planes, scalars count 2^-n half quantization steps for some n, and offsets are 0:
/// only ratios matter to the surface.
struct TimeSlice {
  Signs<3> signs;
  Scalars<3> scalars;
  double positiveOffset = 0, negativeOffset = 0;
};

/// The slice at a time in frames from 0, clamped to the sequence. On a plane of the lattice it is
/// that plane's data. Between two planes scalars are interpolated; where only one plane has a
/// scalar, both have the same sign, and that scalar is used.
[[nodiscard]] TimeSlice sliceAt(const Surface<4>& surface, double time);

/// The most bytes that a slice takes at any time.
[[nodiscard]] uint64_t memoryToSlice(const Surface<4>& surface);

}  // namespace isostar
