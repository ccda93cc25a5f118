#include "measure/triangle.h"

#include <array>
#include <cmath>

namespace isostar::measure {
namespace {

/// As a fraction of the product of two squared sides: below it, rounding destroys the interior.
constexpr double kFlat = 1e-14;

Vector3 offsetFromSegment(const Vector3& point, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from, offset = point - from;
  const double length = squared(along);
  const double t = length > 0 ? std::clamp(dot(offset, along) / length, 0.0, 1.0) : 0;
  return offset - t * along;
}

/// From the nearest point of the triangle. Dot products with two edges decide whether that is a
/// corner, on an edge, or in the interior (Ericson, Real-Time Collision Detection, 5.1.5).
inline Vector3 offsetFrom(const Vector3& point, const Triangle& t) {
  const Vector3 ab = t.b - t.a, ac = t.c - t.a;
  const Vector3 pa = point - t.a, pb = point - t.b, pc = point - t.c;
  const double abA = dot(ab, pa), acA = dot(ac, pa);
  if (abA <= 0 && acA <= 0) return pa;
  const double abB = dot(ab, pb), acB = dot(ac, pb);
  if (abB >= 0 && acB <= abB) return pb;
  const double abC = dot(ab, pc), acC = dot(ac, pc);
  if (acC >= 0 && abC <= acC) return pc;
  const double c = abA * acB - abB * acA;
  if (c <= 0 && abA >= 0 && abB <= 0 && abA > abB) return pa - abA / (abA - abB) * ab;
  const double b = abC * acA - abA * acC;
  if (b <= 0 && acA >= 0 && acC <= 0 && acA > acC) return pa - acA / (acA - acC) * ac;
  const double a = abB * acC - abC * acB, alongB = acB - abB, alongC = abC - acC;
  if (a <= 0 && alongB >= 0 && alongC >= 0 && alongB + alongC > 0)
    return pb - alongB / (alongB + alongC) * (t.c - t.b);
  const double sum = a + b + c;
  if (sum > kFlat * squared(ab) * squared(ac)) return pa - b / sum * ab - c / sum * ac;
  const std::array<Vector3, 3> offsets = {offsetFromSegment(point, t.a, t.b),
                                          offsetFromSegment(point, t.b, t.c),
                                          offsetFromSegment(point, t.c, t.a)};
  return *std::min_element(
      offsets.begin(), offsets.end(),
      [](const Vector3& one, const Vector3& other) { return squared(one) < squared(other); });
}

}  // namespace

double Triangle::area() const {
  return 0.5 * std::sqrt(squared(cross(b - a, c - a)));
}

double squaredDistance(const Vector3& point, const Triangle& triangle) {
  return squared(offsetFrom(point, triangle));
}

Vector3 nearestPoint(const Vector3& point, const Triangle& triangle) {
  return point - offsetFrom(point, triangle);
}

}  // namespace isostar::measure
