// Decides which cells of an adaptive mesh are kept, and the scalars of coarse vertices.
#include "encoder/adaptive/adaptive_plan.h"

#include <algorithm>
#include <cmath>

#include "encoder/core/source_distance.h"

namespace isostar {

template <int D>
AdaptivePlan<D>::AdaptivePlan(const GridField<D>& field, const Header& header,
                              const Signs<D>& finest)
    : field_(field), finestLevel_(header.finestLevel()) {
  for (int a = 0; a < D; ++a) unit_[a] = edgeLength(header.placement, 1u << a);
  crossings_ = findCrossings(field, unit_, finest);
  nearest_.resize(static_cast<std::size_t>(finestLevel_) + 1);
  forbidden_.resize(nearest_.size());
  for (int level = 0; level <= finestLevel_; ++level) {
    if (lattice(level).step > kMostStep) continue;
    findNearest(level);
    forbidden_[static_cast<std::size_t>(level)].assign(lattice(level).vertices(), 0);
  }
}

/// Each crossing is compared with the vertices within two steps of it.
template <int D>
void AdaptivePlan<D>::findNearest(int level) {
  const auto grid = lattice(level);
  auto& nearest = nearest_[static_cast<std::size_t>(level)];
  nearest.assign(grid.vertices(), kNone);
  std::vector<float> best(nearest.size(), INFINITY);
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      const int32_t plane = static_cast<int32_t>(crossings_[i].position[a]) / grid.step;
      low[a] = std::clamp(plane - 1, 0, grid.last[a]);
      high[a] = std::clamp(plane + 2, 0, grid.last[a]);
    }
    for (auto v = low;;) {
      double squares = 0;
      for (int a = 0; a < D; ++a) {
        const double d = (grid.sample(a, v[a]) - crossings_[i].position[a]) * unit_[a];
        squares += d * d;
      }
      const std::size_t at = index(grid, v);
      if (squares < best[at]) {
        best[at] = static_cast<float>(squares);
        nearest[at] = static_cast<uint32_t>(i);
      }
      int a = 0;
      for (; a < D && ++v[a] > high[a]; ++a) v[a] = low[a];
      if (a == D) break;
    }
  }
}

/// The distance from a vertex to the surface in grid steps. Near the surface it is that to a plane.
/// Infinite if no crossing is near.
template <int D>
double AdaptivePlan<D>::distance(int level, const Coordinates<D>& v) const {
  constexpr double kPlane = 1.5;
  const auto grid = lattice(level);
  const uint32_t n = nearest_[static_cast<std::size_t>(level)][index(grid, v)];
  if (n == kNone) return INFINITY;
  const Crossing& c = crossings_[n];
  double squares = 0, along = 0;
  for (int a = 0; a < D; ++a) {
    const double d = (grid.sample(a, v[a]) - c.position[a]) * unit_[a];
    squares += d * d;
    along += d * c.normal[a];
  }
  const double far = std::sqrt(squares);
  return far < kPlane ? std::abs(along) : far;
}

template <int D>
double AdaptivePlan<D>::scalar(int level, const Coordinates<D>& v) const {
  constexpr double kLeast = 1e-3;  // grid steps: a scalar must have a sign
  const auto grid = lattice(level);
  const double actual = field_.scalar(grid.samples(v));
  if (level == finestLevel_ || grid.step > kMostStep) return actual;
  const uint32_t n = nearest_[static_cast<std::size_t>(level)][index(grid, v)];
  if (n == kNone) return actual;
  const double size = std::max(kLeast, distance(level, v)) * crossings_[n].gradient;
  return actual > 0 ? size : -size;
}

/// Can the cell be halved on all axes?
template <int D>
bool AdaptivePlan<D>::splittable(int level, const Coordinates<D>& cell) const {
  const auto finer = lattice(level + 1);
  for (int a = 0; a < D; ++a) {
    if (!finer.isNew(a, 2 * cell[a] + 1)) return false;
  }
  return true;
}

/// At a point of a cell: the linear function of the simplex that holds it, and the size of its
/// gradient per grid step.
template <int D>
std::pair<double, double> AdaptivePlan<D>::linear(int level, const Coordinates<D>& cell,
                                                  const Point& p) const {
  const auto grid = lattice(level);
  std::array<double, D> along;   // 0 at the even corner, 1 at the odd one
  std::array<double, D> length;  // of the cell, in grid steps
  Coordinates<D> v;
  std::array<int, D> order;
  for (int a = 0; a < D; ++a) {
    const int32_t low = grid.sample(a, cell[a]), high = grid.sample(a, cell[a] + 1);
    const double u = (p[a] - low) / (high - low);
    const bool lowIsEven = cell[a] % 2 == 0;
    along[a] = lowIsEven ? u : 1 - u;
    length[a] = (high - low) * unit_[a];
    v[a] = cell[a] + (lowIsEven ? 0 : 1);
    order[a] = a;
  }
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return along[a] != along[b] ? along[a] > along[b] : a < b; });
  double before = scalar(level, v), value = before, squares = 0;
  for (const int a : order) {
    v[a] = 2 * cell[a] + 1 - v[a];
    const double here = scalar(level, v), difference = here - before;
    value += difference * along[a];
    squares += difference * difference / (length[a] * length[a]);
    before = here;
  }
  return {value, std::sqrt(squares)};
}

template <int D>
bool AdaptivePlan<D>::surfaceFits(int level, const Coordinates<D>& cell, const Point& p,
                                  double distance) const {
  const auto [value, gradient] = linear(level, cell, p);
  return std::abs(value) <= distance * gradient;
}

/// Does the linear function have the field's sign at all those samples of the cell that are further
/// from the surface than `allowed`?
template <int D>
bool AdaptivePlan<D>::signsFit(int level, const Coordinates<D>& cell, double allowed) const {
  const auto grid = lattice(level);
  Coordinates<D> low, high;
  for (int a = 0; a < D; ++a) {
    low[a] = grid.sample(a, cell[a]);
    high[a] = grid.sample(a, cell[a] + 1);
  }
  for (auto v = low;;) {
    Point p;
    for (int a = 0; a < D; ++a) p[a] = v[a];
    if ((linear(level, cell, p).first > 0) != (field_.scalar(v) > 0) &&
        !(distance(finestLevel_, v) <= allowed))
      return false;
    int a = 0;
    for (; a < D && ++v[a] > high[a]; ++a) v[a] = low[a];
    if (a == D) return true;
  }
}

template <int D>
void AdaptivePlan<D>::findKeptCells(double allowed) {
  cells_.assign(nearest_.size(), {});
  for (int level = 0; level < finestLevel_; ++level) {
    const auto grid = lattice(level);
    if (grid.step > kMostStep) continue;
    auto& cells = cells_[static_cast<std::size_t>(level)];
    cells.assign(grid.vertices(), kEmpty);
    std::vector<Coordinates<D>> found;
    for (const Crossing& c : crossings_) {
      Coordinates<D> cell;
      for (int a = 0; a < D; ++a)
        cell[a] = std::min(static_cast<int32_t>(c.position[a]) / grid.step, grid.last[a] - 1);
      const std::size_t at = index(grid, cell);
      uint8_t& state = cells[at];
      if (state == kSplit) continue;
      if (state == kEmpty) {
        found.push_back(cell);
        state = splittable(level, cell) && forbidden_[static_cast<std::size_t>(level)][at] == 0
                    ? kWhole
                    : kSplit;
      }
      if (state == kWhole && !surfaceFits(level, cell, c.position, allowed)) state = kSplit;
    }
    for (const auto& cell : found) {
      uint8_t& state = cells[index(grid, cell)];
      if (state == kWhole && !signsFit(level, cell, allowed)) state = kSplit;
    }
  }
}

template <int D>
Signs<D> AdaptivePlan<D>::centres(int level) const {
  Signs<D> centres(lattice(level));
  const auto grid = lattice(level - 1);
  const auto& cells = cells_[static_cast<std::size_t>(level) - 1];
  if (cells.empty()) return centres;
  for (Coordinates<D> v{};;) {
    if (cells[index(grid, v)] == kWhole) {
      Coordinates<D> centre;
      for (int a = 0; a < D; ++a) centre[a] = 2 * v[a] + 1;
      centres.set(centre, true);
    }
    int a = 0;
    for (; a < D && ++v[a] > grid.last[a]; ++a) v[a] = 0;
    if (a == D) return centres;
  }
}

template <int D>
bool AdaptivePlan<D>::forbid(const Point& p, double reach) {
  for (int level = 0; level < finestLevel_; ++level) {
    const auto& cells = cells_[static_cast<std::size_t>(level)];
    if (cells.empty()) continue;
    const auto grid = lattice(level);
    Coordinates<D> low, high;
    const double around = reach * grid.step;
    for (int a = 0; a < D; ++a) {
      low[a] = std::clamp(static_cast<int32_t>(p[a] - around) / grid.step, 0, grid.last[a]);
      high[a] = std::clamp(static_cast<int32_t>(p[a] + around) / grid.step, 0, grid.last[a]);
    }
    bool any = false;
    for (auto v = low;;) {
      const std::size_t at = index(grid, v);
      if (cells[at] == kWhole) {
        forbidden_[static_cast<std::size_t>(level)][at] = 1;
        any = true;
      }
      int a = 0;
      for (; a < D && ++v[a] > high[a]; ++a) v[a] = low[a];
      if (a == D) break;
    }
    if (any) return true;
  }
  return false;
}

template class AdaptivePlan<2>;
template class AdaptivePlan<3>;

}  // namespace isostar
