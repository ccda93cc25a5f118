// The linear function on a simplex of the RBMT.
#pragma once

#include <cmath>

#include "bisection/tagged_simplex.h"

namespace isostar {

template <int D>
using Vector = std::array<double, D>;

template <int D>
double dot(const Vector<D>& v, const Vector<D>& w) {
  double sum = 0;
  for (int a = 0; a < D; ++a) sum += v[a] * w[a];
  return sum;
}

/// The linear function with given values at the simplex's vertices. Lengths are in grid steps.
template <int D>
class LinearFunction {
 public:
  /// values(vertex) → double. The simplex must not be flat.
  template <class Values>
  LinearFunction(const Hierarchy<D>& hierarchy, const TaggedSimplex<D>& s, const Values& values)
      : origin_(hierarchy.position(s.vertices[0])), value_(values(s.vertices[0])) {
    // Vertex i differs from vertex 0 on one axis on which no earlier vertex does: forward
    // substitution solves the equations.
    for (int i = 1; i <= D; ++i) {
      const auto at = hierarchy.position(s.vertices[i]);
      double rise = values(s.vertices[i]) - value_;
      int newAxis = 0;
      for (int a = 0; a < D; ++a) {
        if (at[a] == origin_[a]) continue;
        if ((known_ >> a & 1) == 0) newAxis = a;
        rise -= gradient_[a] * (at[a] - origin_[a]);
      }
      known_ |= 1u << newAxis;
      gradient_[newAxis] = rise / (at[newAxis] - origin_[newAxis]);
    }
  }

  [[nodiscard]] const Vector<D>& gradient() const { return gradient_; }
  /// The length of the gradient.
  [[nodiscard]] double steepness() const { return std::sqrt(dot<D>(gradient_, gradient_)); }
  /// The value at a sample's position.
  [[nodiscard]] double at(const Coordinates<D>& position) const {
    double value = value_;
    for (int a = 0; a < D; ++a) value += gradient_[a] * (position[a] - origin_[a]);
    return value;
  }

 private:
  Coordinates<D> origin_;
  double value_;
  Vector<D> gradient_{};
  unsigned known_ = 0;
};

}  // namespace isostar
