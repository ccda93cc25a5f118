#include "tetrahedra/boundary.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "tetrahedra/tetrahedron.h"

namespace isostar::native {
namespace {

using measure::Vector3;

constexpr double kStep =
    1e-4;  // before a face, as a part of its size: who is met there lies on the other side

struct Face {
  std::array<uint32_t, 3> places, corners;  // places sorted; corners counter-clockwise from outside
  uint32_t tetrahedron;
};

/// The same number for points at the same place.
std::vector<uint32_t> placesOf(const std::vector<Vector3>& points) {
  const auto key = [&](uint32_t i) { return std::tuple(points[i].x, points[i].y, points[i].z); };
  std::vector<uint32_t> order(points.size()), places(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  for (size_t i = 0; i < order.size(); ++i)
    places[order[i]] =
        i > 0 && key(order[i]) == key(order[i - 1]) ? places[order[i - 1]] : order[i];
  return places;
}

/// The faces of one tetrahedron only.
std::vector<Face> singleFaces(const TetrahedralMesh& mesh, const std::vector<uint32_t>& places) {
  constexpr std::array<std::array<size_t, 3>, 4> kFaces = {
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tetrahedra.size());
  for (uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    for (const auto& [a, b, c] : kFaces) {
      const Corners4& corners = mesh.tetrahedra[t];
      Face face{{places[corners[a]], places[corners[b]], places[corners[c]]},
                {corners[a], corners[b], corners[c]},
                t};
      std::sort(face.places.begin(), face.places.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.places < b.places; });
  std::vector<Face> single;
  for (size_t i = 0, end; i < faces.size(); i = end) {
    for (end = i + 1; end < faces.size() && faces[end].places == faces[i].places;) ++end;
    if (end == i + 1) single.push_back(faces[i]);
  }
  return single;
}

/// Which corner of the tetrahedron lies at a point's place; none: false.
bool hasCorner(const TetrahedralMesh& mesh, const std::vector<uint32_t>& places, uint32_t t,
               uint32_t point) {
  const Corners4& corners = mesh.tetrahedra[t];
  return std::any_of(corners.begin(), corners.end(),
                     [&](uint32_t c) { return places[c] == places[point]; });
}

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

bool isCovered(const TetrahedralMesh& mesh, const TetrahedronTree& tree, const Face& face) {
  const Vector3 &a = mesh.points[face.corners[0]], &b = mesh.points[face.corners[1]],
                &c = mesh.points[face.corners[2]];
  const Vector3 normal = cross(b - a, c - a);
  const double area = std::sqrt(squared(normal));
  if (area == 0) return false;
  const Vector3 before = (1.0 / 3) * (a + b + c) + (kStep / std::sqrt(area)) * normal;
  return isInAny(mesh, tree, before, [&](uint32_t t) { return t != face.tetrahedron; });
}

}  // namespace

Boundary boundaryOf(const TetrahedralMesh& mesh, const TetrahedronTree& tree) {
  const std::vector<uint32_t> places = placesOf(mesh.points);
  Boundary boundary;
  std::vector<uint32_t> vertex(mesh.points.size(), UINT32_MAX), suspects;
  for (const Face& face : singleFaces(mesh, places)) {
    if (isCovered(mesh, tree, face)) {
      suspects.insert(suspects.end(), face.places.begin(), face.places.end());
      continue;
    }
    for (uint32_t corner : face.corners) {
      uint32_t& index = vertex[places[corner]];
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
                       [&](uint32_t t) { return !hasCorner(mesh, places, t, point); });
      }));
  return boundary;
}

}  // namespace isostar::native
