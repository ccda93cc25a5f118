// The quantization step of a stream: what the crossings of its isovalues require.
#pragma once

#include <algorithm>
#include <deque>

#include "encoder/core/coded_crossing.h"
#include "encoder/core/source.h"

namespace isostar {

/// "Lossless" means that every vertex is within this distance of the source's, in grid steps: less
/// than the spacing of 32-bit coordinates beyond 512 samples.
inline constexpr double kLosslessError = 1.0 / (1 << 14);

/// Quantization may take this part of the bound at most, if a finer step can.
inline constexpr double kQuantizationShare = 16;

/// The size of a scalar as a stream's steps have it, in steps. `shift`: of the isovalue above the
/// first one, from which all scalars are counted.
[[nodiscard]] inline double codedSize(const Header& header, double scalar, int32_t shift) {
  const double steps = scalar / header.quantizationStep + shift;
  const double magnitude = std::floor(std::min(std::abs(steps), Header::kMostMagnitude)) + 0.5;
  return std::abs((steps > 0 ? magnitude : -magnitude) - shift);
}

/// The largest distance by which quantization alone moves a vertex of a source's surface.
template <int D>
[[nodiscard]] double quantizationError(const Header& header, const Source<D>& source) {
  if (header.whole) return 0;
  const int32_t shift = header.shift(source.isovalue());
  return std::ranges::max(
      ofBrickPieces(source.active(), source.runTasks(), [&](const BrickRange& range) {
        double most = 0;
        forEachCrossingEdge(
            header, source.signs(), source.active(), range, [](std::size_t) {},
            [&](const EdgeEnds<D>& ends, double length) {
              const double even = source.field().scalar(ends.even),
                           odd = source.field().scalar(ends.odd);
              const CodedCrossing crossing{codedSize(header, even, shift),
                                           codedSize(header, odd, shift), std::abs(even),
                                           std::abs(odd), length};
              crossing.raise(most);
            });
        return most;
      }));
}

/// Makes the step finer where the largest sample would set one that is too coarse for other
/// crossings, as a fill value does: samples beyond the largest magnitude then saturate. Keeps the
/// step that moves vertices least; a step that moves none by more than `allowed` stays.
/// `errorOf(header)`: quantizationError() over all sources of the stream. Returns what is left of
/// it.
template <class ErrorOf>
double chooseStep(Header& header, double allowed, ErrorOf errorOf) {
  constexpr int kMostHalvings = 200;
  double least = errorOf(header);
  Header finer = header;
  for (int i = 0; i < kMostHalvings && least > allowed; ++i) {
    finer.quantizationStep /= 2;
    if (finer.quantizationStep < Header::kLeastStep) return least;
    const double error = errorOf(finer);
    if (error > least) return least;
    least = error;
    header.quantizationStep = finer.quantizationStep;
  }
  return least;
}

}  // namespace isostar
