#include "source_distance.h"

#include <algorithm>
#include <cmath>

#include "completion.h"
#include "crossings.h"

namespace isostar {
namespace {

/// Calls enter(place) for each stride-th active brick and then visit(brick, row, x, axes) for each of its crossed edges.
template <class Enter, class Visit>
void forCrossings(const Signs<3>& signs, const std::vector<uint8_t>& active, std::size_t stride, bool diagonals, Enter enter, Visit visit) {
  Window<3> window;
  for (std::size_t place = 0, number = 0; place < active.size(); ++place) {
    if (active[place] == 0 || number++ % stride != 0) continue;
    const auto brick = signs.table().brick(place);
    window.load(signs, brick);
    enter(place);
    for (unsigned axes = 1; axes < 8; ++axes) {
      if (!diagonals && !std::has_single_bit(axes)) continue;
      for (unsigned r = 0; r < 64; ++r) {
        const uint32_t inside = edgesInside(signs.lattice(), brick, r, axes);
        if (inside == 0) continue;
        const int row = Window<3>::row({0, static_cast<int32_t>(r & 7), static_cast<int32_t>(r >> 3)});
        for (uint32_t open = crossedEdges(window, row, r, axes) & inside; open != 0; open &= open - 1) {
          visit(brick, r, static_cast<unsigned>(std::countr_zero(open)), axes);
        }
      }
    }
  }
}

double length(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace

uint64_t countCrossings(const Signs<3>& signs, const std::vector<uint8_t>& active) {
  uint64_t count = 0;
  forCrossings(signs, active, 1, false, [](std::size_t) {}, [&](const Coordinates<3>&, unsigned, unsigned, unsigned) { ++count; });
  return count;
}

double edgeLength(const Placement& placement, unsigned axes) {
  double sum = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if ((axes >> a & 1) != 0) sum += placement.spacing[a] * placement.spacing[a];
  }
  return std::sqrt(sum) / std::ranges::min(placement.spacing);
}

/// Where the source crosses an edge, from its first end (0) to its second (1).
double SourceDistance::crossing(const Coordinates<3>& even, const Coordinates<3>& odd) const {
  const double a = std::abs(field_.scalar(even)), b = std::abs(field_.scalar(odd));
  return a + b > 0 ? a / (a + b) : 0.5;
}

/// The source's unit normal at an edge, in grid steps along the smallest spacing.
SourceDistance::Point SourceDistance::normal(const Coordinates<3>& even, const Coordinates<3>& odd) const {
  Point n{};
  for (std::size_t a = 0; a < 3; ++a) {
    for (const auto* end : {&even, &odd}) {
      Coordinates<3> low = *end, high = *end;
      low[a] = std::max(low[a] - 1, 0);
      high[a] = std::min(high[a] + 1, field_.last()[a]);
      if (high[a] > low[a]) n[a] += (field_.scalar(high) - field_.scalar(low)) / (high[a] - low[a]);
    }
    n[a] /= edgeLength(header_.placement, 1u << a);
  }
  const double size = length(n);
  for (double& v : n) v = size > 0 ? v / size : 0;
  return n;
}

/// The distance from a point (in samples) to the source's surface, as far as 2 step + 2 samples reach.
double SourceDistance::nearest(const Point& p, int32_t step) const {
  Coordinates<3> centre;
  Point unit;
  for (std::size_t a = 0; a < 3; ++a) {
    centre[a] = static_cast<int32_t>(std::lround(p[a]));
    unit[a] = edgeLength(header_.placement, 1u << a);
  }
  double best = 1e30;
  Coordinates<3> bestEven{}, bestOdd{};
  Point bestOffset{};
  const int32_t reach = 2 * step + 2;
  int32_t enough = reach;
  for (int32_t radius = 0; radius <= enough; ++radius) {
    for (int32_t z = -radius; z <= radius; ++z) {
      for (int32_t y = -radius; y <= radius; ++y) {
        const bool shell = std::abs(z) == radius || std::abs(y) == radius;
        for (int32_t x = -radius; x <= radius; x += shell || radius == 0 ? 1 : 2 * radius) {
          const Coordinates<3> v{centre[0] + x, centre[1] + y, centre[2] + z};
          if (v[0] < 0 || v[1] < 0 || v[2] < 0 || v[0] > field_.last()[0] || v[1] > field_.last()[1] || v[2] > field_.last()[2]) continue;
          const bool positive = field_.scalar(v) > 0;
          for (std::size_t a = 0; a < 3; ++a) {
            Coordinates<3> next = v;
            if (++next[a] > field_.last()[a] || (field_.scalar(next) > 0) == positive) continue;
            Point offset{v[0] - p[0], v[1] - p[1], v[2] - p[2]};
            offset[a] += crossing(v, next);
            for (std::size_t b = 0; b < 3; ++b) offset[b] *= unit[b];
            const double distance = length(offset);
            if (distance >= best) continue;
            best = distance;
            bestEven = v;
            bestOdd = next;
            bestOffset = offset;
            enough = std::min(reach, radius + 1);
          }
        }
      }
    }
  }
  if (best > 1e29) return reach;
  if (best > 1.5) return best;
  // Near by, the surface is a plane: a vertex may lie beside the foot.
  const Point n = normal(bestEven, bestOdd);
  return std::min(best, std::abs(bestOffset[0] * n[0] + bestOffset[1] * n[1] + bestOffset[2] * n[2]));
}

/// Where the surface told so far crosses an edge.
double SourceDistance::decoded(const ScalarWindow<3>& scalars, const EdgeEnds& ends) const {
  auto size = [&](int at) {
    const double value = scalars.value[static_cast<std::size_t>(at)];
    return value >= 0 ? value + 2 * header_.positiveOffset - 1 : 2 * header_.negativeOffset - 1 - value;
  };
  const double a = size(ends.evenAt), b = size(ends.oddAt);
  return a + b > 0 ? a / (a + b) : 0.5;
}

double SourceDistance::rms(const Signs<3>& signs, const Scalars<3>& scalars, const std::vector<uint8_t>& active) const {
  constexpr uint64_t kCoarseSamples = 128;  // each searches for the nearest crossing
  constexpr std::size_t kFineBricks = 100;
  const int32_t step = signs.lattice().step;
  const bool told = !active.empty();
  const auto bricks = told ? active : activeBricks(signs);
  Scalars<3> estimated = told ? Scalars<3>() : Scalars<3>(bricks.size());
  if (!told) estimateMissing(signs, bricks, Members::AxisEnds, 0, estimated);
  const Scalars<3>& known = told ? scalars : estimated;
  const bool fine = step == 1;
  const uint64_t every = fine ? 1 : countCrossings(signs, bricks) / kCoarseSamples + 1;
  const std::size_t stride = fine ? static_cast<std::size_t>(std::count(bricks.begin(), bricks.end(), 1)) / kFineBricks + 1 : 1;
  ScalarWindow<3> window;
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
      [&](const Coordinates<3>& brick, unsigned r, unsigned x, unsigned axes) {
        if (number++ % every != 0) return;
        if (!loaded) window.load(known, signs.table(), brick);
        loaded = true;
        const EdgeEnds ends(brick, r, x, axes);
        const double t = decoded(window, ends);
        double distance = 0;
        if (fine) {
          const auto axis = static_cast<std::size_t>(std::countr_zero(axes));
          distance = (t - crossing(ends.even, ends.odd)) * edgeLength(header_.placement, axes) * normal(ends.even, ends.odd)[axis];
        } else {
          Point p;
          for (int a = 0; a < 3; ++a) {
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

std::vector<uint8_t> SourceDistance::beyond(double bound, const Signs<3>& signs, const Scalars<3>& scalars, const std::vector<uint8_t>& active) const {
  const auto& table = signs.table();
  std::vector<uint8_t> places(active.size(), 0);
  bool any = false;
  ScalarWindow<3> window;
  forCrossings(
      signs, active, 1, header_.polygonizer == Polygonizer::Tetrahedra,
      [&](std::size_t place) { window.load(scalars, table, table.brick(place)); },
      [&](const Coordinates<3>& brick, unsigned r, unsigned x, unsigned axes) {
        const EdgeEnds ends(brick, r, x, axes);
        if (std::abs(decoded(window, ends) - crossing(ends.even, ends.odd)) * edgeLength(header_.placement, axes) <= bound) return;
        for (const auto& end : {ends.even, ends.odd}) places[table.place({end[0] / kBrickSide, end[1] / kBrickSide, end[2] / kBrickSide})] = 1;
        any = true;
      });
  return any ? places : std::vector<uint8_t>();
}

}  // namespace isostar
