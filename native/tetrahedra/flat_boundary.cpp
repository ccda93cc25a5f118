#include "tetrahedra/flat_boundary.h"

#include <algorithm>
#include <cmath>

#include "measure/triangle.h"

namespace isostar::native {
namespace {

using measure::Vector3;

constexpr double kRounding = 1e-6;  // of the largest coordinate, which is in single precision

std::array<double, 3> coordinates(const Vector3& p) {
  return {p.x, p.y, p.z};
}

/// Merges parts whose coordinates are equal up to rounding.
void mergeEqual(std::vector<FlatPart>& parts, double rounding) {
  std::sort(parts.begin(), parts.end(),
            [](const FlatPart& a, const FlatPart& b) { return a.coordinate < b.coordinate; });
  size_t kept = 0;
  for (size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].coordinate - parts[kept].coordinate <= rounding)
      parts[kept].share += parts[i].share;
    else
      parts[++kept] = parts[i];
  }
  parts.resize(std::min(parts.size(), kept + 1));
}

}  // namespace

std::array<std::vector<FlatPart>, 3> flatParts(const Mesh& boundary) {
  std::array<std::vector<FlatPart>, 3> parts;
  double whole = 0, largest = 0;
  for (float x : boundary.positions) largest = std::max(largest, std::abs(double{x}));
  const double rounding = kRounding * largest;
  for (size_t t = 0; t < boundary.indices.size(); t += 3) {
    const auto corner = [&](size_t c) {
      return measure::vertexAt(boundary.positions, boundary.indices[t + c]);
    };
    const double area = measure::Triangle{corner(0), corner(1), corner(2)}.area();
    const auto a = coordinates(corner(0)), b = coordinates(corner(1)), c = coordinates(corner(2));
    for (size_t axis = 0; axis < 3; ++axis) {
      if (std::max(std::abs(a[axis] - b[axis]), std::abs(a[axis] - c[axis])) <= rounding)
        parts[axis].push_back({.coordinate = a[axis], .share = area});
    }
    whole += area;
  }
  for (auto& axis : parts) {
    mergeEqual(axis, rounding);
    for (FlatPart& part : axis) part.share /= whole;
  }
  return parts;
}

}  // namespace isostar::native
