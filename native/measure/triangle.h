#pragma once

#include <algorithm>

#include "measure/vector3.h"

namespace isostar::measure {

struct Triangle {
  Vector3 a, b, c;

  double area() const;
  Vector3 at(double u, double v) const { return a + u * (b - a) + v * (c - a); }
};

/// The squared distance from the point to the triangle, which may be degenerate to a segment or a
/// point.
double squaredDistance(const Vector3& point, const Triangle&);
Vector3 nearestPoint(const Vector3& point, const Triangle&);

}  // namespace isostar::measure
