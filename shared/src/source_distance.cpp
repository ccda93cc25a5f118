#include "source_distance.h"

#include <algorithm>
#include <cmath>

#include "completion.h"
#include "crossings.h"

namespace isostar {
namespace {

/// Calls enter(place) for each stride-th active brick and then visit(brick, row, x, axes) for each of its crossed edges.
template <int D, class Enter, class Visit>
void forCrossings(const Signs<D>& signs, const std::vector<uint8_t>& active, std::size_t stride, bool diagonals, Enter enter, Visit visit) {
  Window<D> window;
  for (std::size_t place = 0, number = 0; place < active.size(); ++place) {
    if (active[place] == 0 || number++ % stride != 0) continue;
    const auto brick = signs.table().brick(place);
    window.load(signs, brick);
    enter(place);
    for (unsigned axes = 1; axes < 1u << D; ++axes) {
      if (!diagonals && !std::has_single_bit(axes)) continue;
      for (unsigned r = 0; r < Window<D>::kOwnRows.size(); ++r) {
        const uint32_t inside = edgesInside(signs.lattice(), brick, r, axes);
        if (inside == 0) continue;
        const int row = Window<D>::kOwnRows[r];
        for (uint32_t open = crossedEdges(window, row, r, axes) & inside; open != 0; open &= open - 1) {
          visit(brick, r, static_cast<unsigned>(std::countr_zero(open)), axes);
        }
      }
    }
  }
}

template <std::size_t D>
double dot(const std::array<double, D>& a, const std::array<double, D>& b) {
  double sum = a[0] * b[0];
  for (std::size_t i = 1; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

template <int D>
uint64_t countCrossings(const Signs<D>& signs, const std::vector<uint8_t>& active) {
  uint64_t count = 0;
  forCrossings(signs, active, 1, false, [](std::size_t) {}, [&](const Coordinates<D>&, unsigned, unsigned, unsigned) { ++count; });
  return count;
}

double edgeLength(const Placement& placement, unsigned axes) {
  const double step = std::ranges::min(placement.spacing);
  double sum = (axes >> 3 & 1) != 0 ? step * step : 0;
  for (unsigned a = 0; a < 3; ++a) {
    if ((axes >> a & 1) != 0) sum += placement.spacing[a] * placement.spacing[a];
  }
  return std::sqrt(sum) / step;
}

/// Where the source crosses an edge, from its first end (0) to its second (1).
template <int D>
double SourceDistance<D>::crossing(const Coordinates<D>& even, const Coordinates<D>& odd) const {
  const double a = std::abs(field_.scalar(even)), b = std::abs(field_.scalar(odd));
  return a + b > 0 ? a / (a + b) : 0.5;
}

/// The source's unit normal at an edge, in grid steps along the smallest spacing.
template <int D>
typename SourceDistance<D>::Point SourceDistance<D>::normal(const Coordinates<D>& even, const Coordinates<D>& odd) const {
  Point n{};
  for (std::size_t a = 0; a < D; ++a) {
    for (const auto* end : {&even, &odd}) {
      Coordinates<D> low = *end, high = *end;
      low[a] = std::max(low[a] - 1, 0);
      high[a] = std::min(high[a] + 1, field_.last()[a]);
      if (high[a] > low[a]) n[a] += (field_.scalar(high) - field_.scalar(low)) / (high[a] - low[a]);
    }
    n[a] /= edgeLength(header_.placement, 1u << a);
  }
  const double size = std::sqrt(dot(n, n));
  for (double& v : n) v = size > 0 ? v / size : 0;
  return n;
}

/// The distance from a point (in samples) to the source's surface, as far as 2 step + 2 samples reach.
template <int D>
double SourceDistance<D>::nearest(const Point& p, int32_t step) const {
  Coordinates<D> centre;
  Point unit;
  for (std::size_t a = 0; a < D; ++a) {
    centre[a] = static_cast<int32_t>(std::lround(p[a]));
    unit[a] = edgeLength(header_.placement, 1u << a);
  }
  double best = 1e30;
  Coordinates<D> bestEven{}, bestOdd{};
  Point bestOffset{};
  const int32_t reach = 2 * step + 2;
  int32_t enough = reach;
  for (int32_t radius = 0; radius <= enough; ++radius) {
    Coordinates<D> d;
    d.fill(-radius);
    for (bool more = true; more;) {
      bool shell = radius == 0, inside = true;
      Coordinates<D> v;
      for (int a = 1; a < D; ++a) {
        v[a] = centre[a] + d[a];
        shell = shell || std::abs(d[a]) == radius;
        inside = inside && v[a] >= 0 && v[a] <= field_.last()[a];
      }
      for (int32_t x = -radius; inside && x <= radius; x += shell ? 1 : 2 * radius) {
        v[0] = centre[0] + x;
        if (v[0] < 0 || v[0] > field_.last()[0]) continue;
        const bool positive = field_.scalar(v) > 0;
        for (int a = 0; a < D; ++a) {
          Coordinates<D> next = v;
          if (++next[a] > field_.last()[a] || (field_.scalar(next) > 0) == positive) continue;
          Point offset;
          for (int b = 0; b < D; ++b) offset[b] = v[b] - p[b];
          offset[a] += crossing(v, next);
          for (int b = 0; b < D; ++b) offset[b] *= unit[b];
          const double distance = std::sqrt(dot(offset, offset));
          if (distance >= best) continue;
          best = distance;
          bestEven = v;
          bestOdd = next;
          bestOffset = offset;
          enough = std::min(reach, radius + 1);
        }
      }
      int a = 1;
      for (; a < D && ++d[a] > radius; ++a) d[a] = -radius;
      more = a < D;
    }
  }
  if (best > 1e29) return reach;
  if (best > 1.5) return best;
  // Near by, the surface is a plane: a vertex may lie beside the foot.
  const Point n = normal(bestEven, bestOdd);
  return std::min(best, std::abs(dot(bestOffset, n)));
}

/// Where the surface told so far crosses an edge.
template <int D>
double SourceDistance<D>::decoded(const ScalarWindow<D>& scalars, const EdgeEnds<D>& ends) const {
  auto size = [&](int at) {
    const double value = scalars.value[static_cast<std::size_t>(at)];
    return value >= 0 ? value + 2 * header_.positiveOffset - 1 : 2 * header_.negativeOffset - 1 - value;
  };
  const double a = size(ends.evenAt), b = size(ends.oddAt);
  return a + b > 0 ? a / (a + b) : 0.5;
}

template <int D>
double SourceDistance<D>::rms(const Signs<D>& signs, const Scalars<D>& scalars, const std::vector<uint8_t>& active) const {
  constexpr uint64_t kCoarseSamples = 128;  // each searches for the nearest crossing
  constexpr std::size_t kFineBricks = 100;
  const int32_t step = signs.lattice().step;
  const bool told = !active.empty();
  const auto bricks = told ? active : activeBricks(signs);
  Scalars<D> estimated = told ? Scalars<D>() : Scalars<D>(bricks.size());
  if (!told) estimateMissing(signs, bricks, Members::AxisEnds, 0, estimated);
  const Scalars<D>& known = told ? scalars : estimated;
  const bool fine = step == 1;
  const uint64_t every = fine ? 1 : countCrossings(signs, bricks) / kCoarseSamples + 1;
  const std::size_t stride = fine ? static_cast<std::size_t>(std::count(bricks.begin(), bricks.end(), 1)) / kFineBricks + 1 : 1;
  ScalarWindow<D> window;
  std::size_t entered = 0;
  bool loaded = false;
  uint64_t number = 0, samples = 0;
  double sum = 0;
  forCrossings(
      signs, bricks, stride, false,
      [&](std::size_t place) {
        entered = place;
        loaded = false;
      },
      [&](const Coordinates<D>& brick, unsigned r, unsigned x, unsigned axes) {
        if (number++ % every != 0) return;
        if (!loaded) window.load(known, signs.table(), brick);
        loaded = true;
        const EdgeEnds<D> ends(brick, r, x, axes);
        const double t = decoded(window, ends);
        double distance = 0;
        if (fine) {
          const auto axis = static_cast<std::size_t>(std::countr_zero(axes));
          distance = (t - crossing(ends.even, ends.odd)) * edgeLength(header_.placement, axes) * normal(ends.even, ends.odd)[axis];
        } else {
          Point p;
          for (int a = 0; a < D; ++a) {
            const double from = signs.lattice().sample(a, ends.even[a]), to = signs.lattice().sample(a, ends.odd[a]);
            p[static_cast<std::size_t>(a)] = from + t * (to - from);
          }
          distance = nearest(p, step);
        }
        sum += distance * distance;
        ++samples;
      });
  return samples == 0 ? 0 : std::sqrt(sum / static_cast<double>(samples));
}

template <int D>
std::vector<uint8_t> SourceDistance<D>::beyond(double bound, const Signs<D>& signs, const Scalars<D>& scalars, const std::vector<uint8_t>& active) const {
  const auto& table = signs.table();
  std::vector<uint8_t> places(active.size(), 0);
  bool any = false;
  ScalarWindow<D> window;
  forCrossings(
      signs, active, 1, header_.polygonizer == Polygonizer::Tetrahedra,
      [&](std::size_t place) { window.load(scalars, table, table.brick(place)); },
      [&](const Coordinates<D>& brick, unsigned r, unsigned x, unsigned axes) {
        const EdgeEnds<D> ends(brick, r, x, axes);
        if (std::abs(decoded(window, ends) - crossing(ends.even, ends.odd)) * edgeLength(header_.placement, axes) <= bound) return;
        for (Coordinates<D> end : {ends.even, ends.odd}) {
          for (int32_t& v : end) v /= kBrickSide;
          places[table.place(end)] = 1;
        }
        any = true;
      });
  return any ? places : std::vector<uint8_t>();
}

template uint64_t countCrossings<2>(const Signs<2>&, const std::vector<uint8_t>&);
template uint64_t countCrossings<3>(const Signs<3>&, const std::vector<uint8_t>&);
template uint64_t countCrossings<4>(const Signs<4>&, const std::vector<uint8_t>&);
template class SourceDistance<2>;
template class SourceDistance<3>;
template class SourceDistance<4>;

}  // namespace isostar
