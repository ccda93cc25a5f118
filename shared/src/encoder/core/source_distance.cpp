// Measures the distance between the surface coded so far and the source's.
#include "encoder/core/source_distance.h"

#include <algorithm>
#include <cmath>

#include "encoder/core/vertex_cloud.h"
#include "estimate/completion.h"

namespace isostar {
namespace {

template <std::size_t D>
double dot(const std::array<double, D>& a, const std::array<double, D>& b) {
  double sum = a[0] * b[0];
  for (std::size_t i = 1; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

/// At most `most` of the marked bricks, evenly spread.
std::vector<uint8_t> someOf(const std::vector<uint8_t>& marked, std::size_t most) {
  const std::size_t stride =
      static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1)) / most + 1;
  std::vector<uint8_t> some(marked.size(), 0);
  std::size_t number = 0;
  for (std::size_t brickIndex = 0; brickIndex < marked.size(); ++brickIndex) {
    if (marked[brickIndex] != 0 && number++ % stride == 0) some[brickIndex] = 1;
  }
  return some;
}

}  // namespace

double edgeLength(const Placement& placement, unsigned axes) {
  const double step = std::ranges::min(placement.spacing);
  double sum = (axes >> 3 & 1) != 0 ? step * step : 0;
  for (unsigned a = 0; a < 3; ++a) {
    if ((axes >> a & 1) != 0) sum += placement.spacing[a] * placement.spacing[a];
  }
  return std::sqrt(sum) / step;
}

template <int D>
SourceDistance<D>::SourceDistance(const GridField<D>& field, const Header& header,
                                  const Signs<D>& signs, const std::vector<uint8_t>& active)
    : field_(field), header_(header), bricks_(active.size(), 0) {
  constexpr std::size_t kBricks = 96;
  constexpr uint64_t kSamples = 1024;
  for (int a = 0; a < D; ++a) unit_[a] = edgeLength(header.placement, 1u << a);
  const auto bricks = someOf(active, kBricks);
  const uint64_t stride = countCrossings(signs, bricks) / kSamples + 1;
  uint64_t number = 0;
  std::size_t brickIndex = 0;
  forCrossedRows(
      signs, bricks, false, [&](std::size_t entered) { brickIndex = entered; },
      [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
        for (; crossed != 0; crossed &= crossed - 1) {
          if (number++ % stride != 0) continue;
          const EdgeEnds<D> ends(brick, r, static_cast<unsigned>(std::countr_zero(crossed)), axes);
          const auto axis = static_cast<std::size_t>(std::countr_zero(axes));
          Sample sample{
              brickIndex, ends.evenAt, ends.oddAt,  field.crossing(ends.even, ends.odd, axis),
              0,          {},          normal(ends)};
          sample.perEdge = unit_[axis] * sample.normal[axis];
          for (std::size_t a = 0; a < D; ++a)
            sample.position[a] =
                (ends.even[a] + sample.crossing * (ends.odd[a] - ends.even[a])) * unit_[a];
          samples_.push_back(sample);
          for (const auto& end : {ends.even, ends.odd})
            bricks_[signs.table().brickIndexOf(end)] = 1;
        }
      });
}

/// The source's unit normal at an edge.
template <int D>
typename SourceDistance<D>::Point SourceDistance<D>::normal(const EdgeEnds<D>& ends) const {
  Point n;
  for (std::size_t a = 0; a < D; ++a)
    n[a] = (field_.slope(ends.even, a) + field_.slope(ends.odd, a)) / unit_[a];
  const double size = std::sqrt(dot(n, n));
  for (double& v : n) v = size > 0 ? v / size : 0;
  return n;
}

/// Where the surface coded so far crosses an edge, from its even end (0) to its odd end (1).
template <int D>
double SourceDistance<D>::decoded(const ScalarWindow<D>& scalars, const Sample& sample,
                                  double unit) const {
  const double even = sizeOf(scalars.value[static_cast<std::size_t>(sample.evenAt)], header_, unit),
               odd = sizeOf(scalars.value[static_cast<std::size_t>(sample.oddAt)], header_, unit);
  return even + odd > 0 ? even / (even + odd) : 0.5;
}

template <int D>
double SourceDistance<D>::rms(const Signs<D>& coarse, const Hints<D>& hints) const {
  constexpr std::size_t kSamples = 128;  // few, since each requires a search for the nearest vertex
  constexpr double kBeside = 0.75;  // grid steps of the level: up to this distance beside a vertex,
                                    // the surface is taken to continue as a plane
  if (samples_.empty()) return 0;
  const VertexCloud<D> cloud(coarse, unit_, hints);
  if (cloud.empty()) {
    Point box;
    for (std::size_t a = 0; a < D; ++a) box[a] = field_.last()[a] * unit_[a];
    return std::sqrt(dot(box, box));
  }
  const std::size_t stride = samples_.size() / kSamples + 1;
  double sum = 0;
  for (std::size_t i = 0; i < samples_.size(); i += stride) {
    const Point offset = cloud.toNearest(samples_[i].position);
    const double squared = dot(offset, offset), height = dot(offset, samples_[i].normal);
    const double beside = kBeside * coarse.lattice().step;
    sum += squared - height * height < beside * beside ? height * height : squared;
  }
  return std::sqrt(sum / static_cast<double>((samples_.size() + stride - 1) / stride));
}

template <int D>
double SourceDistance<D>::rms(const Signs<D>& finest, const Scalars<D>& scalars,
                              const Hints<D>& hints, int finer) const {
  const auto& table = finest.table();
  const bool coded = scalars.tableSize() != 0;
  Scalars<D> estimated = coded ? Scalars<D>() : Scalars<D>(table.total());
  if (!coded) estimateMissing(finest, bricks_, Members::AxisEnds, 0, estimated, hints);
  ScalarWindow<D> window;
  std::size_t loaded = SIZE_MAX;
  const double unit = std::ldexp(1, -finer);
  double sum = 0;
  for (const Sample& sample : samples_) {
    if (sample.brickIndex != loaded)
      window.load(coded ? scalars : estimated, table, table.brick(sample.brickIndex));
    loaded = sample.brickIndex;
    const double distance = (decoded(window, sample, unit) - sample.crossing) * sample.perEdge;
    sum += distance * distance;
  }
  return samples_.empty() ? 0 : std::sqrt(sum / static_cast<double>(samples_.size()));
}

template class SourceDistance<2>;
template class SourceDistance<3>;
template class SourceDistance<4>;

}  // namespace isostar
