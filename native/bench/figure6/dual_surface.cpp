#include "bench/figure6/dual_surface.h"

#include <algorithm>
#include <cmath>

namespace isostar::bench {
namespace {

constexpr int kRelaxations = 6;

using Point = DualSurface::Point;

/// The cells of the octree's grid from -1 to the last plane. The outermost ones have zero width.
class Cells {
 public:
  Cells(const Lattice<3>& lattice, const Point& unit)
      : lattice_(lattice), unit_(unit), vertexOf_(index(lattice.last) + 1, UINT32_MAX) {}

  [[nodiscard]] Point corner(const Coordinates<3>& v) const {
    Point p;
    for (int a = 0; a < 3; ++a) {
      const int32_t sample = lattice_.sample(a, std::clamp(v[a], 0, lattice_.last[a]));
      p[static_cast<size_t>(a)] = sample * unit_[static_cast<size_t>(a)];
    }
    return p;
  }
  /// The number of the cell's vertex; `newVertex` is the number of the next new one.
  uint32_t vertex(const Coordinates<3>& cell, size_t newVertex) {
    uint32_t& vertex = vertexOf_[index(cell)];
    if (vertex == UINT32_MAX) vertex = static_cast<uint32_t>(newVertex);
    return vertex;
  }

 private:
  [[nodiscard]] size_t index(const Coordinates<3>& cell) const {
    size_t at = 0;
    for (int a = 2; a >= 0; --a)
      at = at * static_cast<size_t>(lattice_.last[a] + 2) + static_cast<size_t>(cell[a] + 1);
    return at;
  }

  const Lattice<3>& lattice_;
  const Point& unit_;
  std::vector<uint32_t> vertexOf_;
};

/// Calls visit(lower end, axis, its sign) for each crossing edge. A flat grid has no cells and no
/// crossing edges.
template <class Visit>
void forEachCrossing(const Lattice<3>& lattice, const DualSurface::Positive& positive,
                     Visit visit) {
  if (std::any_of(lattice.last.begin(), lattice.last.end(), [](int32_t last) { return last == 0; }))
    return;
  for (Coordinates<3> v{}; v[2] <= lattice.last[2]; ++v[2]) {
    for (v[1] = 0; v[1] <= lattice.last[1]; ++v[1]) {
      for (v[0] = 0; v[0] <= lattice.last[0]; ++v[0]) {
        const bool sign = positive(v);
        for (int a = 0; a < 3; ++a) {
          auto end = v;
          if (++end[a] <= lattice.last[a] && positive(end) != sign) visit(v, a, sign);
        }
      }
    }
  }
}

}  // namespace

DualSurface::DualSurface(const Lattice<3>& lattice, const Point& unit, const Positive& positive) {
  Cells cells(lattice, unit);
  std::vector<uint32_t> crossings;  // the number of crossing edges of each vertex's cell
  forEachCrossing(lattice, positive, [&](const Coordinates<3>& v, int axis, bool sign) {
    auto end = v;
    ++end[axis];
    const Point from = cells.corner(v), to = cells.corner(end);
    std::array<uint32_t, 4> quad;
    constexpr int32_t kAround[4][2] = {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}};
    for (size_t i = 0; i < 4; ++i) {
      auto cell = v;
      cell[(axis + 1) % 3] += kAround[i][0];
      cell[(axis + 2) % 3] += kAround[i][1];
      const uint32_t vertex = quad[i] = cells.vertex(cell, positions_.size());
      if (vertex == positions_.size()) {
        positions_.push_back({});
        crossings.push_back(0);
        cells_.push_back(
            {cells.corner(cell), cells.corner({cell[0] + 1, cell[1] + 1, cell[2] + 1})});
      }
      ++crossings[vertex];
      for (size_t a = 0; a < 3; ++a) positions_[vertex][a] += (from[a] + to[a]) / 2;
    }
    if (!sign) std::swap(quad[1], quad[3]);
    quads_.push_back(quad);
  });
  for (size_t v = 0; v < positions_.size(); ++v) {
    for (size_t a = 0; a < 3; ++a)
      positions_[v][a] =
          std::clamp(positions_[v][a] / crossings[v], cells_[v].low[a], cells_[v].high[a]);
  }
  link();
  relax(kRelaxations);
  findNormals();
}

void DualSurface::link() {
  firstNeighbour_.assign(positions_.size() + 1, 0);
  for (const auto& quad : quads_) {
    for (uint32_t v : quad) firstNeighbour_[v + 1] += 2;
  }
  for (size_t v = 0; v < positions_.size(); ++v) firstNeighbour_[v + 1] += firstNeighbour_[v];
  neighbours_.resize(firstNeighbour_.back());
  auto next = firstNeighbour_;
  for (const auto& quad : quads_) {
    for (size_t i = 0; i < 4; ++i) {
      neighbours_[next[quad[i]]++] = quad[(i + 1) % 4];
      neighbours_[next[quad[i]]++] = quad[(i + 3) % 4];
    }
  }
}

void DualSurface::relax(int rounds) {
  for (int round = 0; round < rounds; ++round) {
    auto moved = positions_;
    for (size_t v = 0; v < positions_.size(); ++v) {
      Point sum{};
      forEachNeighbour(v, [&](uint32_t w) {
        for (size_t a = 0; a < 3; ++a) sum[a] += positions_[w][a];
      });
      const double count = firstNeighbour_[v + 1] - firstNeighbour_[v];
      for (size_t a = 0; a < 3; ++a)
        moved[v][a] = std::clamp(0.5 * (positions_[v][a] + sum[a] / count), cells_[v].low[a],
                                 cells_[v].high[a]);
    }
    positions_ = std::move(moved);
  }
}

void DualSurface::findNormals() {
  normals_.assign(positions_.size(), {});
  for (const auto& quad : quads_) {
    Point d, e;
    for (size_t a = 0; a < 3; ++a) {
      d[a] = positions_[quad[2]][a] - positions_[quad[0]][a];
      e[a] = positions_[quad[3]][a] - positions_[quad[1]][a];
    }
    for (uint32_t v : quad) {
      for (size_t a = 0; a < 3; ++a)
        normals_[v][a] += d[(a + 1) % 3] * e[(a + 2) % 3] - d[(a + 2) % 3] * e[(a + 1) % 3];
    }
  }
  for (Point& n : normals_) {
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& x : n) x = length > 0 ? x / length : 0;
  }
}

Mesh DualSurface::mesh(const std::vector<double>& displacements) const {
  Mesh mesh;
  for (size_t v = 0; v < positions_.size(); ++v) {
    for (size_t a = 0; a < 3; ++a) {
      const bool inEnd = cells_[v].low[a] == cells_[v].high[a];
      const double by = displacements.empty() || inEnd ? 0 : displacements[v] * normals_[v][a];
      mesh.positions.push_back(static_cast<float>(positions_[v][a] + by));
    }
  }
  const auto squaredLength = [&](uint32_t v, uint32_t w) {
    double sum = 0;
    for (size_t a = 0; a < 3; ++a)
      sum += std::pow(mesh.positions[3 * v + a] - mesh.positions[3 * w + a], 2);
    return sum;
  };
  for (const auto& quad : quads_) {
    // Splits along the shorter diagonal.
    const size_t first = squaredLength(quad[0], quad[2]) <= squaredLength(quad[1], quad[3]) ? 0 : 1;
    for (size_t corner : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(quad[(first + corner) % 4]);
  }
  return mesh;
}

}  // namespace isostar::bench
