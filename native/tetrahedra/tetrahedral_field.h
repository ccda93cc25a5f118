#pragma once

#include <optional>

#include "measure/triangle_tree.h"
#include "tetrahedra/domain_boundary.h"
#include "tetrahedra/tetrahedral_mesh.h"
#include "tetrahedra/tetrahedron_tree.h"

namespace isostar::native {

/// The piecewise linear function on a tetrahedral mesh (§1, §3), and its domain. Lengths are in the
/// mesh's unit. The argument `near` is a guess as in TriangleTree::distance().
class TetrahedralField {
 public:
  /// `mesh` must be repaired. Its hanging nodes become a remark.
  explicit TetrahedralField(TetrahedralMesh mesh);

  const TetrahedralMesh& mesh() const { return mesh_; }
  const Boundary& boundary() const { return boundary_; }

  /// The function's value; nothing outside the domain.
  std::optional<double> value(const measure::Vector3& point) const;
  bool inside(const measure::Vector3& point) const { return value(point).has_value(); }

  /// The continuation beyond the domain: the linear function of the tetrahedron at the nearest
  /// boundary point, constant beyond the distance `reach`, which limits the values of steep
  /// functions.
  double beyond(const measure::Vector3& point, double reach, uint32_t& near) const;

  /// The signed distance to the domain's boundary, positive inside.
  double domainDistance(const measure::Vector3& point, uint32_t& near) const;
  double boundaryDistance(const measure::Vector3& point, uint32_t& near) const {
    return faces_.distance(point, near);
  }

 private:
  TetrahedralMesh mesh_;
  TetrahedronTree tree_;
  Boundary boundary_;
  measure::TriangleTree faces_;
};

}  // namespace isostar::native
