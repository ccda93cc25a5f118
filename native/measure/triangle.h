#pragma once

#include <algorithm>

#include "measure/vector3.h"

namespace isostar::measure {

struct Triangle {
  Vector3 a, b, c;

  double area() const;
  Vector3 at(double u, double v) const { return a + u * (b - a) + v * (c - a); }
};

/// From the point to the nearest of the triangle's points, squared; also where the triangle is a
/// segment or a point.
double squaredDistance(const Vector3& point, const Triangle&);
Vector3 nearestPoint(const Vector3& point, const Triangle&);

}  // namespace isostar::measure
