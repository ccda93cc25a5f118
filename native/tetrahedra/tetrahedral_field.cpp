#include "tetrahedra/tetrahedral_field.h"

#include <cmath>

#include "files/text.h"
#include "tetrahedra/tetrahedron.h"

namespace isostar::native {

using measure::Vector3;

TetrahedralField::TetrahedralField(TetrahedralMesh mesh)
    : mesh_(std::move(mesh)),
      tree_(mesh_),
      boundary_(boundaryOf(mesh_, tree_)),
      faces_(boundary_.mesh) {
  if (boundary_.hangingNodes > 0)
    mesh_.remarks.push_back(text("hanging nodes: %zu", boundary_.hangingNodes));
}

std::optional<double> TetrahedralField::value(const Vector3& point) const {
  std::optional<double> found;
  tree_.visit(point, [&](uint32_t t) {
    const Tetrahedron tetrahedron(mesh_, mesh_.tetrahedra[t]);
    const Shares shares = tetrahedron.shares(point);
    if (shares.least() >= -kShareRounding) found = tetrahedron.value(shares);
    return found.has_value();
  });
  return found;
}

double TetrahedralField::beyond(const Vector3& point, double reach, uint32_t& near) const {
  const double distance = faces_.distance(point, near);
  const Vector3 onFace = nearestPoint(point, faces_.triangle(near));
  const double part = distance > reach ? reach / distance : 1;
  const Tetrahedron tetrahedron(mesh_, mesh_.tetrahedra[boundary_.tetrahedra[faces_.index(near)]]);
  return tetrahedron.value(tetrahedron.shares(onFace + part * (point - onFace)));
}

double TetrahedralField::domainDistance(const Vector3& point, uint32_t& near) const {
  const double distance = faces_.distance(point, near);
  return inside(point) ? distance : -distance;
}

}  // namespace isostar::native
