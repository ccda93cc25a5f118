#pragma once

#include <optional>

#include "measure/triangle_tree.h"
#include "tetrahedra/boundary.h"
#include "tetrahedra/tetrahedral_mesh.h"
#include "tetrahedra/tetrahedron_tree.h"

namespace isostar::native {

/// The piecewise linear function on a tetrahedral mesh (§1, §3), and the domain outside of which
/// there is none. Lengths are the mesh's own. What a call says of `near` is TriangleTree's: a
/// guess, which saves time where points follow each other.
class TetrahedralField {
 public:
  /// `mesh` is mended; hanging nodes of it become a remark.
  explicit TetrahedralField(TetrahedralMesh mesh);

  const TetrahedralMesh& mesh() const { return mesh_; }
  const Boundary& boundary() const { return boundary_; }

  /// Nothing outside the domain.
  std::optional<double> value(const measure::Vector3& point) const;
  bool inside(const measure::Vector3& point) const { return value(point).has_value(); }

  /// The linear function of the tetrahedron behind the nearest boundary point; farther than `reach`
  /// from there it does not change any more, so that a steep one cannot run away.
  double beyond(const measure::Vector3& point, double reach, uint32_t& near) const;

  /// To the domain's boundary, positive inside.
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
