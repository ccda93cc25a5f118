// The vertices of a coarse surface by brick, for fast searches of the nearest one to a point.
#pragma once

#include <cmath>
#include <limits>

#include "estimate/completion.h"
#include "scalars/crossings.h"

namespace isostar {

template <int D>
class VertexCloud {
 public:
  using Point = std::array<double, D>;

  /// The vertices of the surface that Polygonizer::Cubes makes of a level's signs and hints.
  /// `unit`: the distance between samples by axis, at least 1.
  VertexCloud(const Signs<D>& signs, const Point& unit, const Hints<D>& hints)
      : lattice_(signs.lattice()), table_(signs.table()), first_(table_.total() + 1), unit_(unit) {
    const auto active = activeBricks(signs);
    Scalars<D> scalars(active.size());
    estimateMissing(signs, active, Members::AxisEnds, 0, scalars, hints);
    ScalarWindow<D> window;
    std::size_t entered = 0;
    auto finish = [&](std::size_t brickIndex) {
      while (entered < brickIndex) first_[++entered] = vertices_.size();
    };
    forCrossedRows(
        signs, active, false,
        [&](std::size_t brickIndex) {
          finish(brickIndex);
          window.load(scalars, table_, table_.brick(brickIndex));
        },
        [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
          for (; crossed != 0; crossed &= crossed - 1) {
            const EdgeEnds<D> ends(brick, r, static_cast<unsigned>(std::countr_zero(crossed)),
                                   axes);
            const double even = std::abs(window.value[static_cast<std::size_t>(ends.evenAt)]),
                         odd = std::abs(window.value[static_cast<std::size_t>(ends.oddAt)]);
            vertices_.push_back(between(ends, even / (even + odd)));
          }
        });
    finish(table_.total());
  }

  [[nodiscard]] bool empty() const { return vertices_.empty(); }

  /// The vector from a point to the nearest vertex; the cloud must not be empty. Lengths in terms
  /// of `unit`.
  [[nodiscard]] Point toNearest(const Point& p) const {
    Coordinates<D> centre;
    for (int a = 0; a < D; ++a)
      centre[a] = std::clamp(static_cast<int32_t>(p[a] / side(a)), 0, table_.count(a) - 1);
    int32_t rings = 1;
    for (int a = 0; a < D; ++a) rings = std::max(rings, table_.count(a));
    Nearest nearest;
    // A brick of ring n + 1 is at least n bricks away.
    for (int32_t ring = 0;
         ring < rings &&
         nearest.squared > square(std::max(0, ring - 1) * kBrickSide * double(lattice_.step));
         ++ring)
      scanRing(p, centre, ring, nearest);
    return nearest.offset;
  }

 private:
  struct Nearest {
    double squared = std::numeric_limits<double>::infinity();
    Point offset{};
  };

  static double square(double v) { return v * v; }
  [[nodiscard]] double side(int axis) const { return kBrickSide * unit_[axis] * lattice_.step; }

  [[nodiscard]] Point between(const EdgeEnds<D>& ends, double t) const {
    Point p;
    for (int a = 0; a < D; ++a) {
      const double from = lattice_.sample(a, ends.even[a]), to = lattice_.sample(a, ends.odd[a]);
      p[a] = (from + t * (to - from)) * unit_[a];
    }
    return p;
  }

  /// Scans the bricks whose largest distance to the centre on an axis is `ring`.
  void scanRing(const Point& p, const Coordinates<D>& centre, int32_t ring,
                Nearest& nearest) const {
    Coordinates<D> from, to;
    for (int a = 0; a < D; ++a) {
      from[a] = std::max(centre[a] - ring, 0);
      to[a] = std::min(centre[a] + ring, table_.count(a) - 1);
    }
    for (auto brick = from;;) {
      int32_t away = 0;
      for (int a = 0; a < D; ++a) away = std::max(away, std::abs(brick[a] - centre[a]));
      if (away == ring) scan(p, brick, nearest);
      int a = 0;
      for (; a < D && ++brick[a] > to[a]; ++a) brick[a] = from[a];
      if (a == D) return;
    }
  }

  void scan(const Point& p, const Coordinates<D>& brick, Nearest& nearest) const {
    const std::size_t brickIndex = table_.index(brick);
    if (first_[brickIndex] == first_[brickIndex + 1]) return;
    double least = 0;
    for (int a = 0; a < D; ++a) {
      const double low = brick[a] * side(a) - p[a];
      least += square(std::max({low, -low - side(a), 0.0}));
    }
    if (least >= nearest.squared) return;
    for (std::size_t v = first_[brickIndex]; v < first_[brickIndex + 1]; ++v) {
      Point offset;
      double squared = 0;
      for (int a = 0; a < D; ++a) {
        offset[a] = vertices_[v][a] - p[a];
        squared += square(offset[a]);
      }
      if (squared < nearest.squared) nearest = {squared, offset};
    }
  }

  Lattice<D> lattice_;
  BrickTable<D> table_;
  std::vector<Point> vertices_;
  /// By brick index: its first vertex; then the number of all vertices.
  std::vector<std::size_t> first_;
  Point unit_;
};

}  // namespace isostar
