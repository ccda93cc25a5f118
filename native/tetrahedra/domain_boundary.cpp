#include "tetrahedra/domain_boundary.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "tetrahedra/tetrahedron.h"

namespace isostar::native {
namespace {

using measure::Vector3;

/// The distance in front of a face at which the other side is tested, as a fraction of the face's
/// size.
constexpr double kStep = 1e-4;

struct Face {
  /// Ids are sorted; corners are counter-clockwise seen from outside.
  std::array<uint32_t, 3> positionIds, corners;
  uint32_t tetrahedron;
};

/// A number for each point, which is the same for points at the same position.
std::vector<uint32_t> positionIdsOf(const std::vector<Vector3>& points) {
  const auto key = [&](uint32_t i) { return std::tuple(points[i].x, points[i].y, points[i].z); };
  std::vector<uint32_t> order(points.size()), positionIds(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  for (size_t i = 0; i < order.size(); ++i)
    positionIds[order[i]] =
        i > 0 && key(order[i]) == key(order[i - 1]) ? positionIds[order[i - 1]] : order[i];
  return positionIds;
}

/// The faces that belong to only one tetrahedron.
std::vector<Face> singleFaces(const TetrahedralMesh& mesh,
                              const std::vector<uint32_t>& positionIds) {
  constexpr std::array<std::array<size_t, 3>, 4> kFaces = {
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tetrahedra.size());
  for (uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    for (const auto& [a, b, c] : kFaces) {
      const Corners4& corners = mesh.tetrahedra[t];
      Face face{.positionIds = {positionIds[corners[a]], positionIds[corners[b]],
                                positionIds[corners[c]]},
                .corners = {corners[a], corners[b], corners[c]},
                .tetrahedron = t};
      std::sort(face.positionIds.begin(), face.positionIds.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.positionIds < b.positionIds; });
  std::vector<Face> single;
  for (size_t i = 0, end; i < faces.size(); i = end) {
    for (end = i + 1; end < faces.size() && faces[end].positionIds == faces[i].positionIds;) ++end;
    if (end == i + 1) single.push_back(faces[i]);
  }
  return single;
}

/// Whether a corner of the tetrahedron is at a point's position.
bool hasCorner(const TetrahedralMesh& mesh, const std::vector<uint32_t>& positionIds, uint32_t t,
               uint32_t point) {
  const Corners4& corners = mesh.tetrahedra[t];
  return std::any_of(corners.begin(), corners.end(),
                     [&](uint32_t c) { return positionIds[c] == positionIds[point]; });
}

/// Whether any tetrahedron that `accept` admits contains the point.
template <class Accept>
bool isInAny(const TetrahedralMesh& mesh, const TetrahedronTree& tree, const Vector3& point,
             Accept accept) {
  bool found = false;
  tree.visit(point, [&](uint32_t t) {
    if (!accept(t)) return false;
    found = Tetrahedron(mesh, mesh.tetrahedra[t]).shares(point).least() >= -kShareRounding;
    return found;
  });
  return found;
}

/// Whether another tetrahedron lies in front of the face.
bool isCovered(const TetrahedralMesh& mesh, const TetrahedronTree& tree, const Face& face) {
  const Vector3 &a = mesh.points[face.corners[0]], &b = mesh.points[face.corners[1]],
                &c = mesh.points[face.corners[2]];
  const Vector3 normal = cross(b - a, c - a);
  const double area = std::sqrt(squared(normal));
  if (area == 0) return false;
  const Vector3 inFront = (1.0 / 3) * (a + b + c) + (kStep / std::sqrt(area)) * normal;
  return isInAny(mesh, tree, inFront, [&](uint32_t t) { return t != face.tetrahedron; });
}

}  // namespace

Boundary boundaryOf(const TetrahedralMesh& mesh, const TetrahedronTree& tree) {
  const std::vector<uint32_t> positionIds = positionIdsOf(mesh.points);
  Boundary boundary;
  std::vector<uint32_t> vertex(mesh.points.size(), UINT32_MAX), suspects;
  for (const Face& face : singleFaces(mesh, positionIds)) {
    if (isCovered(mesh, tree, face)) {
      suspects.insert(suspects.end(), face.positionIds.begin(), face.positionIds.end());
      continue;
    }
    for (uint32_t corner : face.corners) {
      uint32_t& index = vertex[positionIds[corner]];
      if (index == UINT32_MAX) {
        const Vector3& p = mesh.points[corner];
        index = static_cast<uint32_t>(boundary.mesh.positions.size() / 3);
        for (double x : {p.x, p.y, p.z}) boundary.mesh.positions.push_back(static_cast<float>(x));
      }
      boundary.mesh.indices.push_back(index);
    }
    boundary.tetrahedra.push_back(face.tetrahedron);
  }
  std::sort(suspects.begin(), suspects.end());
  suspects.erase(std::unique(suspects.begin(), suspects.end()), suspects.end());
  boundary.hangingNodes =
      static_cast<size_t>(std::count_if(suspects.begin(), suspects.end(), [&](uint32_t point) {
        return isInAny(mesh, tree, mesh.points[point],
                       [&](uint32_t t) { return !hasCorner(mesh, positionIds, t, point); });
      }));
  return boundary;
}

}  // namespace isostar::native
