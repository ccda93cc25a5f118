#pragma once

#include <algorithm>

#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// A point's barycentric coordinates in a tetrahedron: one share for each corner, with sum 1, all
/// non-negative inside.
struct Shares {
  std::array<double, 4> share;
  double least() const { return *std::min_element(share.begin(), share.end()); }
};

/// A tetrahedron of a repaired mesh, prepared for interpolation.
class Tetrahedron {
 public:
  Tetrahedron(const TetrahedralMesh& mesh, const Corners4& corners)
      : a_(mesh.points[corners[0]]),
        values_{mesh.values[corners[0]], mesh.values[corners[1]], mesh.values[corners[2]],
                mesh.values[corners[3]]} {
    const measure::Vector3 b = mesh.points[corners[1]] - a_, c = mesh.points[corners[2]] - a_,
                           d = mesh.points[corners[3]] - a_;
    const double inverse = 1 / dot(cross(b, c), d);
    slopes_ = {inverse * cross(c, d), inverse * cross(d, b), inverse * cross(b, c)};
  }

  Shares shares(const measure::Vector3& point) const {
    const measure::Vector3 offset = point - a_;
    const double b = dot(slopes_[0], offset), c = dot(slopes_[1], offset),
                 d = dot(slopes_[2], offset);
    return {{1 - b - c - d, b, c, d}};
  }

  /// The linear function of the corners' values, also outside the tetrahedron.
  double value(const Shares& shares) const {
    double sum = 0;
    for (size_t i = 0; i < 4; ++i) sum += shares.share[i] * values_[i];
    return sum;
  }

 private:
  measure::Vector3 a_;
  std::array<double, 4> values_;
  std::array<measure::Vector3, 3> slopes_;  // gradients of the shares of corners 1, 2 and 3
};

/// Rounding may make the share of a point on a face negative by this much.
inline constexpr double kShareRounding = 1e-9;

}  // namespace isostar::native
