#include "tetrahedra/extended_surface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace isostar::native {
namespace {

using measure::Triangle;
using measure::Vector3;

constexpr double kOnEdge = 1e-6;  // of an edge's length: coordinates are in single precision

uint64_t edgeAfter(const Mesh& mesh, size_t corner) {
  const size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
  const auto [low, high] = std::minmax(mesh.indices[corner], mesh.indices[next]);
  return uint64_t{low} << 32 | high;
}

bool isOnEdge(const Vector3& point, const Vector3& a, const Vector3& b) {
  return squared(cross(b - a, point - a)) <= kOnEdge * kOnEdge * squared(b - a) * squared(b - a);
}

bool isOnBorder(const Vector3& point, const Triangle& t, uint8_t borderEdges) {
  return (borderEdges & 1 && isOnEdge(point, t.a, t.b)) ||
         (borderEdges & 2 && isOnEdge(point, t.b, t.c)) ||
         (borderEdges & 4 && isOnEdge(point, t.c, t.a));
}

}  // namespace

ExtendedSurface::ExtendedSurface(const Mesh& mesh)
    : tree_(mesh), borderEdges_(mesh.indices.size() / 3) {
  std::unordered_map<uint64_t, int> uses;
  for (size_t corner = 0; corner < mesh.indices.size(); ++corner) ++uses[edgeAfter(mesh, corner)];
  for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
    if (uses[edgeAfter(mesh, corner)] == 1)
      borderEdges_[corner / 3] |= static_cast<uint8_t>(1 << corner % 3);
  }
}

ExtendedSurface::Distance ExtendedSurface::distance(const Vector3& point, uint32_t& near) const {
  const double toSurface = tree_.distance(point, near);
  const Triangle triangle = tree_.triangle(near);
  const Vector3 nearest = nearestPoint(point, triangle),
                normal = cross(triangle.b - triangle.a, triangle.c - triangle.a);
  const double length = std::sqrt(squared(normal));
  if (length == 0 || !isOnBorder(nearest, triangle, borderEdges_[tree_.index(near)]))
    return {toSurface, toSurface};
  return {toSurface, std::abs(dot(normal, point - nearest)) / length};
}

}  // namespace isostar::native
