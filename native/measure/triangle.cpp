#include "measure/triangle.h"

#include <cmath>

namespace isostar::measure {
namespace {

constexpr double kFlat = 1e-14;  // of the sides' squares: such a triangle has no inside that rounding leaves intact

double squaredDistanceToSegment(const Vector3& point, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from, offset = point - from;
  const double length = squared(along);
  const double t = length > 0 ? std::clamp(dot(offset, along) / length, 0.0, 1.0) : 0;
  return squared(offset - t * along);
}

}  // namespace

double Triangle::area() const {
  return 0.5 * std::sqrt(squared(cross(b - a, c - a)));
}

// Which corner, edge or inside is nearest shows in the point's products with two edges (Ericson, Real-Time Collision
// Detection, 5.1.5).
double squaredDistance(const Vector3& point, const Triangle& t) {
  const Vector3 ab = t.b - t.a, ac = t.c - t.a;
  const Vector3 pa = point - t.a, pb = point - t.b, pc = point - t.c;
  const double abA = dot(ab, pa), acA = dot(ac, pa);
  if (abA <= 0 && acA <= 0) return squared(pa);
  const double abB = dot(ab, pb), acB = dot(ac, pb);
  if (abB >= 0 && acB <= abB) return squared(pb);
  const double abC = dot(ab, pc), acC = dot(ac, pc);
  if (acC >= 0 && abC <= acC) return squared(pc);
  const double c = abA * acB - abB * acA;
  if (c <= 0 && abA >= 0 && abB <= 0 && abA > abB) return squared(pa - abA / (abA - abB) * ab);
  const double b = abC * acA - abA * acC;
  if (b <= 0 && acA >= 0 && acC <= 0 && acA > acC) return squared(pa - acA / (acA - acC) * ac);
  const double a = abB * acC - abC * acB, alongB = acB - abB, alongC = abC - acC;
  if (a <= 0 && alongB >= 0 && alongC >= 0 && alongB + alongC > 0)
    return squared(pb - alongB / (alongB + alongC) * (t.c - t.b));
  const double sum = a + b + c;
  if (sum > kFlat * squared(ab) * squared(ac)) return squared(pa - b / sum * ab - c / sum * ac);
  return std::min({squaredDistanceToSegment(point, t.a, t.b), squaredDistanceToSegment(point, t.b, t.c),
                   squaredDistanceToSegment(point, t.c, t.a)});
}

}  // namespace isostar::measure
