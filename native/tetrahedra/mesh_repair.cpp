#include "tetrahedra/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

using measure::Vector3;

/// As a fraction of the longest edge's cube: below it, barycentric coordinates are only rounding
/// errors.
constexpr double kFlat = 1e-12;

std::vector<bool> pointsInUse(const TetrahedralMesh& mesh) {
  std::vector<bool> used(mesh.points.size());
  for (const Corners4& corners : mesh.tetrahedra)
    for (uint32_t point : corners) used[point] = true;
  return used;
}

void requireFinite(const TetrahedralMesh& mesh, const std::vector<bool>& used,
                   const std::string& path) {
  size_t bad = 0, first = 0;
  for (size_t i = mesh.points.size(); i-- > 0;) {
    const Vector3& p = mesh.points[i];
    if (!used[i]) continue;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Failure(path, text("point %zu is not finite", i));
    if (std::isfinite(mesh.values[i])) continue;
    first = i;
    ++bad;
  }
  if (bad > 0)
    throw Failure(path, text("not finite: %zu of %zu scalars, the first at point %zu", bad,
                             mesh.values.size(), first));
}

/// Keeps the points in use and merges those of equal position and value.
void mergePoints(TetrahedralMesh& mesh, const std::vector<bool>& used) {
  const auto key = [&](uint32_t i) {
    const Vector3& p = mesh.points[i];
    return std::tuple(p.x, p.y, p.z, mesh.values[i]);
  };
  std::vector<uint32_t> order, newIndex(mesh.points.size());
  for (uint32_t i = 0; i < mesh.points.size(); ++i)
    if (used[i]) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  // The first point of each group represents it. Points keep the order of the file, in which
  // neighbours are close.
  std::vector<uint32_t> first(mesh.points.size());
  for (size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  uint32_t count = 0;
  for (uint32_t i = 0; i < mesh.points.size(); ++i) {
    if (!used[i] || first[i] != i) continue;
    mesh.points[count] = mesh.points[i];
    mesh.values[count] = mesh.values[i];
    newIndex[i] = count++;
  }
  mesh.points.resize(count);
  mesh.values.resize(count);
  for (Corners4& corners : mesh.tetrahedra)
    for (uint32_t& point : corners) point = newIndex[first[point]];
}

/// Six times the volume over the longest edge's cube, with its sign; 0 for a point.
double fullness(const TetrahedralMesh& mesh, const Corners4& c) {
  const Vector3 &a = mesh.points[c[0]], &b = mesh.points[c[1]], &d = mesh.points[c[2]],
                &e = mesh.points[c[3]];
  double longest = 0;
  for (const Vector3& edge : {b - a, d - a, e - a, d - b, e - b, e - d})
    longest = std::max(longest, squared(edge));
  return longest > 0 ? dot(cross(b - a, d - a), e - a) / (longest * std::sqrt(longest)) : 0;
}

size_t dropFlat(TetrahedralMesh& mesh) {
  return std::erase_if(mesh.tetrahedra,
                       [&](const Corners4& c) { return std::abs(fullness(mesh, c)) < kFlat; });
}

/// Gives all tetrahedra positive volume; returns how many had the rarer orientation.
size_t orient(TetrahedralMesh& mesh) {
  size_t inverted = 0;
  for (Corners4& corners : mesh.tetrahedra) {
    if (fullness(mesh, corners) > 0) continue;
    std::swap(corners[2], corners[3]);
    ++inverted;
  }
  return std::min(inverted, mesh.tetrahedra.size() - inverted);
}

size_t dropDoubled(TetrahedralMesh& mesh) {
  const auto sorted = [&](uint32_t t) {
    Corners4 corners = mesh.tetrahedra[t];
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::vector<uint32_t> order(mesh.tetrahedra.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(sorted(a), a) < std::pair(sorted(b), b);
  });
  std::vector<bool> doubled(order.size());
  for (size_t i = 1; i < order.size(); ++i)
    doubled[order[i]] = sorted(order[i]) == sorted(order[i - 1]);
  size_t kept = 0;
  for (size_t t = 0; t < doubled.size(); ++t)
    if (!doubled[t]) mesh.tetrahedra[kept++] = mesh.tetrahedra[t];
  mesh.tetrahedra.resize(kept);
  return doubled.size() - kept;
}

}  // namespace

void repair(TetrahedralMesh& mesh, const std::string& path) {
  const std::vector<bool> used = pointsInUse(mesh);
  requireFinite(mesh, used, path);
  const auto remark = [&mesh](size_t count, const char* what) {
    if (count > 0) mesh.remarks.push_back(text("%s: %zu", what, count));
  };
  remark(static_cast<size_t>(std::count(used.begin(), used.end(), false)),
         "points of no tetrahedron, left out");
  mergePoints(mesh, used);
  remark(dropFlat(mesh), "tetrahedra without a volume, left out");
  remark(dropDoubled(mesh), "doubled tetrahedra, left out");
  remark(orient(mesh), "inverted tetrahedra, reoriented");
  if (mesh.tetrahedra.empty()) throw Failure(path, "has no tetrahedron with a volume");
}

}  // namespace isostar::native
