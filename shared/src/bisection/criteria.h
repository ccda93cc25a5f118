// Criteria for adaptive meshes (§4.3): how far a leaf moves the isosurface, and by how much it
// turns the surface's normals.
#pragma once

#include <limits>

#include "bisection/leaves.h"
#include "bisection/linear_function.h"

namespace isostar {

// Fields are functions of the box's samples, double field(const Coordinates<D>& position), less the
// isovalue: positive where above 0. `values` are the scalars that the mesh's vertices have,
// `source` those of all samples, `signs` the source's signs. Criteria keep references to their
// arguments, which must outlive them.

/// Calls visit(simplex) for the deepest simplices below one, itself included, but not for those
/// below a simplex for which enter(simplex) is false.
template <int D, class Enter, class Visit>
void forEachFinestBelow(const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s,
                        const Enter& enter, const Visit& visit) {
  if (hierarchy.flat(s.vertices) || !enter(s)) return;
  if (s.depth == hierarchy.maxDepth()) {
    visit(s);
    return;
  }
  for (const auto& half : s.halves()) forEachFinestBelow(hierarchy, half, enter, visit);
}

/// Keeps a simplex if the isosurface of its linear function is within a distance of the source's,
/// in both directions and to first order. Where the source's crosses an edge of the deepest
/// simplices inside, the linear function is off by its value over its gradient. Where the linear
/// function's crosses one, the source is off by its value over the gradient there.
template <int D, class Values, class Source>
class DistanceBound {
 public:
  /// `bound` is in grid steps.
  DistanceBound(const Hierarchy<D>& hierarchy, const Signs<D>& signs, const Values& values,
                const Source& source, double bound)
      : hierarchy_(&hierarchy), signs_(&signs), values_(&values), source_(&source), bound_(bound) {}

  bool operator()(const TaggedSimplex<D>& s) const { return distance(s) <= bound_; }

  /// In grid steps; infinite where a gradient vanishes. Once above the bound, it stops searching.
  [[nodiscard]] double distance(const TaggedSimplex<D>& s) const {
    if (!valuesCross(s) && !mayCross(*signs_, *hierarchy_, s)) return 0;
    const LinearFunction<D> linear(
        *hierarchy_, s, [&](const auto& v) { return (*values_)(hierarchy_->position(v)); });
    double farthest = 0;
    forEachFinestBelow(
        *hierarchy_, s,
        [&](const TaggedSimplex<D>& below) {
          return farthest <= bound_ &&
                 (crossed(at(below, linear)) || mayCross(*signs_, *hierarchy_, below));
        },
        [&](const TaggedSimplex<D>& finest) {
          farthest = std::max(farthest, distance(finest, linear));
        });
    return farthest;
  }

 private:
  using Corners = std::array<double, D + 1>;

  static bool crossed(const Corners& corners) {
    return std::any_of(corners.begin() + 1, corners.end(),
                       [&](double value) { return (value > 0) != (corners[0] > 0); });
  }
  [[nodiscard]] bool valuesCross(const TaggedSimplex<D>& s) const {
    Corners corners;
    for (int i = 0; i <= D; ++i) corners[i] = (*values_)(hierarchy_->position(s.vertices[i]));
    return crossed(corners);
  }
  [[nodiscard]] Corners at(const TaggedSimplex<D>& s, const LinearFunction<D>& linear) const {
    Corners corners;
    for (int i = 0; i <= D; ++i) corners[i] = linear.at(hierarchy_->position(s.vertices[i]));
    return corners;
  }

  /// The distance on the edges of one of the deepest simplices.
  [[nodiscard]] double distance(const TaggedSimplex<D>& finest,
                                const LinearFunction<D>& linear) const {
    const auto here = at(finest, linear);
    Corners there;
    for (int i = 0; i <= D; ++i) there[i] = (*source_)(hierarchy_->position(finest.vertices[i]));
    if (!crossed(here) && !crossed(there)) return 0;
    const LinearFunction<D> actual(
        *hierarchy_, finest, [&](const auto& v) { return (*source_)(hierarchy_->position(v)); });
    const double steepness = linear.steepness(), trueSteepness = actual.steepness();
    double farthest = 0;
    for (int i = 0; i <= D; ++i) {
      for (int j = i + 1; j <= D; ++j) {
        farthest =
            std::max({farthest, offAtCrossing(there[i], there[j], here[i], here[j], steepness),
                      offAtCrossing(here[i], here[j], there[i], there[j], trueSteepness)});
      }
    }
    return farthest;
  }

  /// How far the zero of the other function is from that of the function with values a and b at an
  /// edge's ends; 0 if the latter has none on the edge.
  static double offAtCrossing(double a, double b, double otherA, double otherB, double steepness) {
    if ((a > 0) == (b > 0)) return 0;
    const double off = std::abs(otherA + (otherB - otherA) * (a / (a - b)));
    if (off == 0) return 0;
    return steepness > 0 ? off / steepness : std::numeric_limits<double>::infinity();
  }

  const Hierarchy<D>* hierarchy_;
  const Signs<D>* signs_;
  const Values* values_;
  const Source* source_;
  double bound_;
};

/// Keeps a simplex whose normal, the gradient of its linear function, is within an angle of the
/// normals of all deepest simplices inside that the source's isosurface crosses: the mesh is
/// refined where the surface bends. A simplex that the surface enters between its vertices is not
/// kept.
template <int D, class Values, class Source>
class NormalBound {
 public:
  /// `angle` in radians, 0 … π.
  NormalBound(const Hierarchy<D>& hierarchy, const Signs<D>& signs, const Values& values,
              const Source& source, double angle)
      : hierarchy_(&hierarchy), signs_(&signs), values_(&values), source_(&source), angle_(angle) {}

  bool operator()(const TaggedSimplex<D>& s) const { return deviation(s) <= angle_; }

  /// In radians; infinite where the surface is missed, π where a gradient vanishes. Once above the
  /// bound, it stops searching.
  [[nodiscard]] double deviation(const TaggedSimplex<D>& s) const {
    if (!mayCross(*signs_, *hierarchy_, s)) return 0;
    const bool seen = crosses(*signs_, *hierarchy_, s);
    const auto normal = linear(s, *values_).gradient();
    double widest = 0;
    forEachFinestBelow(
        *hierarchy_, s,
        [&](const TaggedSimplex<D>& below) {
          return widest <= angle_ && mayCross(*signs_, *hierarchy_, below);
        },
        [&](const TaggedSimplex<D>& finest) {
          if (!crosses(*signs_, *hierarchy_, finest)) return;
          widest = seen ? std::max(widest, angle(normal, linear(finest, *source_).gradient()))
                        : std::numeric_limits<double>::infinity();
        });
    return widest;
  }

 private:
  template <class Field>
  [[nodiscard]] LinearFunction<D> linear(const TaggedSimplex<D>& s, const Field& field) const {
    return LinearFunction<D>(*hierarchy_, s,
                             [&](const auto& v) { return field(hierarchy_->position(v)); });
  }
  static double angle(const Vector<D>& v, const Vector<D>& w) {
    const double lengths = std::sqrt(dot<D>(v, v) * dot<D>(w, w));
    return std::acos(lengths > 0 ? std::clamp(dot<D>(v, w) / lengths, -1.0, 1.0) : -1.0);
  }

  const Hierarchy<D>* hierarchy_;
  const Signs<D>* signs_;
  const Values* values_;
  const Source* source_;
  double angle_;
};

}  // namespace isostar
