#include "measure/triangle.h"

#include <cmath>

namespace isostar::measure {
namespace {

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

// The point lies over the triangle's inside, or is nearest to one of the edges.
double squaredDistance(const Vector3& point, const Triangle& t) {
  const Vector3 ab = t.b - t.a, bc = t.c - t.b, ca = t.a - t.c;
  const Vector3 normal = cross(ab, t.c - t.a);
  const double size = squared(normal);
  const Vector3 pa = point - t.a, pb = point - t.b, pc = point - t.c;
  const bool outsideAb = dot(cross(ab, pa), normal) < 0;
  const bool outsideBc = dot(cross(bc, pb), normal) < 0;
  const bool outsideCa = dot(cross(ca, pc), normal) < 0;
  if (size > 0 && !outsideAb && !outsideBc && !outsideCa) {
    const double height = dot(pa, normal);
    return height * height / size;
  }
  // Only an edge that has the point on its outer side can be nearest, unless the triangle has no inside at all.
  double best = INFINITY;
  if (outsideAb || size <= 0) best = std::min(best, squaredDistanceToSegment(point, t.a, t.b));
  if (outsideBc || size <= 0) best = std::min(best, squaredDistanceToSegment(point, t.b, t.c));
  if (outsideCa || size <= 0) best = std::min(best, squaredDistanceToSegment(point, t.c, t.a));
  return best;
}

}  // namespace isostar::measure
