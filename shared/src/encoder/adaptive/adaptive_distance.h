// The distance between an adaptive mesh's surface and the source's, in both directions, to first
// order.
#pragma once

#include <cmath>

#include "coding/adaptive/adaptive_level.h"
#include "encoder/adaptive/adaptive_plan.h"
#include "scalars/crossings.h"

namespace isostar {

/// Distances are in grid steps. From the source: at each of its vertices, the distance to the zero
/// of the decoded field. From the decoded surface: the same with the source's field, at those
/// vertices on whose edge the source has none.
template <int D>
class AdaptiveDistance {
 public:
  using Point = typename AdaptivePlan<D>::Point;

  AdaptiveDistance(const AdaptivePlan<D>& plan, const GridField<D>& field,
                   const AdaptiveLevel<D>& decoded)
      : plan_(plan), field_(field), decoded_(decoded), table_(decoded.signs.table()) {}

  /// Calls visit(point, distance) for every `stride`th vertex of the source's surface. Points are
  /// in samples.
  template <class Visit>
  void fromSource(std::size_t stride, Visit visit) const {
    for (std::size_t i = 0; i < plan_.crossings().size(); i += stride) {
      const auto& c = plan_.crossings()[i];
      Coordinates<D> to = c.from;
      ++to[c.axis];
      const double low = value(c.from), high = value(to);
      if (low != 0 && high != 0 && (low > 0) != (high > 0)) {
        visit(c.position, std::abs((low / (low - high) - c.at) *
                                   plan_.unit()[static_cast<std::size_t>(c.axis)] *
                                   c.normal[static_cast<std::size_t>(c.axis)]));
      } else {
        visit(c.position,
              offset(c.from, c.axis, c.at, [&](const Coordinates<D>& v) { return value(v); }));
      }
    }
  }

  /// Calls visit(point, distance) for the vertices of the decoded surface on edges where the source
  /// has none.
  template <class Visit>
  void fromDecoded(Visit visit) const {
    forCrossedRows(
        decoded_.signs, decoded_.active, false, [](std::size_t) {},
        [&](const Coordinates<D>& brick, unsigned r, unsigned axes, uint32_t crossed) {
          for (; crossed != 0; crossed &= crossed - 1) {
            const EdgeEnds<D> ends(brick, r, static_cast<unsigned>(std::countr_zero(crossed)),
                                   axes);
            if ((field_.scalar(ends.even) > 0) != (field_.scalar(ends.odd) > 0)) continue;
            const int axis = std::countr_zero(axes);
            Coordinates<D> from = ends.even, to = ends.odd;
            if (to[axis] < from[axis]) std::swap(from, to);
            const double low = value(from), high = value(to),
                         at = low != 0 && high != 0 ? low / (low - high) : 0.5;
            Point p;
            for (int a = 0; a < D; ++a) p[a] = from[a] + (a == axis ? at : 0);
            visit(p, offset(from, axis, at,
                            [&](const Coordinates<D>& v) { return field_.scalar(v); }));
          }
        });
  }

 private:
  /// The decoded scalar; 0 if it is not known.
  [[nodiscard]] double value(const Coordinates<D>& v) const {
    const auto& scalars = decoded_.scalars.at(table_.brickIndexOf(v));
    const std::size_t number = numberOf<D>(v);
    return scalars.knows(number) ? scalars.value[number] : 0;
  }

  /// The distance from a point of an edge, at `at` from its lower end, to the zero of a field, from
  /// the field's value and gradient there. kFar if they are not known.
  template <class Field>
  double offset(const Coordinates<D>& from, int axis, double at, Field field) const {
    constexpr double kFar = 4;
    Coordinates<D> to = from;
    ++to[axis];
    const double low = field(from), high = field(to);
    if (low == 0 || high == 0) return kFar;
    double squares = 0;
    for (int a = 0; a < D; ++a) {
      double slope = high - low;
      if (a != axis) slope = (1 - at) * difference(from, a, field) + at * difference(to, a, field);
      slope /= plan_.unit()[static_cast<std::size_t>(a)];
      squares += slope * slope;
    }
    return squares > 0 ? std::min(kFar, std::abs(low + at * (high - low)) / std::sqrt(squares))
                       : kFar;
  }

  template <class Field>
  double difference(const Coordinates<D>& v, int axis, Field field) const {
    double sum = 0;
    int count = 0;
    const double here = field(v);
    for (int side = -1; side <= 1; side += 2) {
      auto next = v;
      next[axis] += side;
      if (next[axis] < 0 || next[axis] > field_.last()[axis]) continue;
      const double there = field(next);
      if (there == 0) continue;
      sum += side * (there - here);
      ++count;
    }
    return count == 0 ? 0 : sum / count;
  }

  const AdaptivePlan<D>& plan_;
  const GridField<D>& field_;
  const AdaptiveLevel<D>& decoded_;
  const BrickTable<D>& table_;
};

}  // namespace isostar
