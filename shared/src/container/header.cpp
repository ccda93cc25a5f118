// What follows from a header: levels, offsets, shifts and the fineness of a domain.
#include "container/header.h"

#include <algorithm>
#include <cmath>

namespace isostar {
namespace {

/// An isovalue in steps of 1 or of kByteStep. Clamped far beyond any sample, so that the result is
/// finite.
double stepsOf(double isovalue, double step) {
  constexpr double kFar = 1e300;
  return step == 1 ? isovalue : std::clamp(isovalue * 255, -kFar, kFar);
}

}  // namespace

bool invertible(const Placement& p) {
  constexpr double kFar = 1e30, kWide = 1e20, kStretched = 1e6, kFlat = 1e-6;
  double lengths = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const double length = std::hypot(p.direction[a], p.direction[a + 3], p.direction[a + 6]);
    if (!(std::abs(p.origin[a]) < kFar) || !(p.spacing[a] > 1 / kWide && p.spacing[a] < kWide))
      return false;
    if (!(length > 1 / kStretched && length < kStretched)) return false;
    lengths *= length;
  }
  const auto& d = p.direction;
  const double determinant = d[0] * (d[4] * d[8] - d[5] * d[7]) -
                             d[1] * (d[3] * d[8] - d[5] * d[6]) +
                             d[2] * (d[3] * d[7] - d[4] * d[6]);
  return std::abs(determinant) > kFlat * lengths;
}

int Header::finestLevel() const {
  int32_t cells = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
    cells = std::max(cells, size[a] - 1);
  int finestLevel = 0;
  while (cells > int64_t{kMostBaseCells} << finestLevel) ++finestLevel;
  return finestLevel;
}

uint64_t Header::chunks(int level) const {
  constexpr uint64_t kMany = 1u << 30;  // more than any stream may have
  if (chunkSide == 0) return 1;
  const int64_t side = int64_t{chunkSide} << (finestLevel() - level);
  uint64_t total = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    const int64_t count = std::max<int64_t>(1, (size[a] - 1 + side - 1) / side);
    total = std::min(total * static_cast<uint64_t>(count), kMany);
  }
  return total;
}

int32_t Header::domainFineness() const {
  constexpr int32_t kCoarsest = 2, kFinest = 32;
  if (lossless) return kFinest;
  int32_t steps = kCoarsest;
  while (steps < kFinest && steps * maxError < 1) steps *= 2;
  return steps;
}

int32_t Header::domainReach() const {
  constexpr double kFarthest = 32;  // grid steps; a longer diagonal is clamped to this
  const auto& s = placement.spacing;
  const double diagonal =
      std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / std::min({s[0], s[1], s[2]});
  return static_cast<int32_t>(std::ceil(std::min(diagonal, kFarthest) * domainFineness()));
}

void Header::countWhole(double step) {
  whole = true;
  quantizationStep = step;
  const double steps = stepsOf(isovalue, step), fraction = steps - std::floor(steps);
  positiveOffset = 1 - fraction;
  negativeOffset = fraction;
}

Header Header::at(double other) const {
  Header relative = *this;
  relative.isovalue = other;
  if (whole) relative.countWhole(quantizationStep);
  return relative;
}

bool Header::spans(double other) const {
  double least = isovalue, most = isovalue;
  for (const double each : furtherIsovalues) {
    least = std::min(least, each);
    most = std::max(most, each);
  }
  return other >= least && other <= most;
}

int32_t Header::shift(double other) const {
  const auto wholeSteps = [&](double value) {
    return std::floor(stepsOf(value, quantizationStep));
  };
  const double steps = whole ? wholeSteps(other) - wholeSteps(isovalue)
                             : std::round((other - isovalue) / quantizationStep);
  return static_cast<int32_t>(std::clamp<double>(steps, -kFarSteps, kFarSteps));
}

Header headerOf(const Image& image) {
  const auto& [x, y] = image.spacing;
  Header h;
  h.dimension = 2;
  h.size = {image.size[0], image.size[1], 1, 1};
  h.placement.origin = {image.origin[0], image.origin[1], 0};
  h.placement.spacing = {x, y, std::min(x, y)};
  return h;
}

Header headerOf(const Volume& volume) {
  Header h;
  h.dimension = 3;
  h.size = {volume.size[0], volume.size[1], volume.size[2], 1};
  h.placement = volume.placement;
  return h;
}

Header headerOf(const Sequence& sequence) {
  Header h;
  h.dimension = 4;
  h.size = {sequence.size[0], sequence.size[1], sequence.size[2], sequence.frames};
  h.placement = sequence.placement;
  return h;
}

}  // namespace isostar
