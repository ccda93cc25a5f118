#pragma once

#include <vector>

#include "measure/triangle_tree.h"

namespace isostar::native {

/// A surface that goes on in its triangles' planes beyond its rim, for distances. The mesh must
/// have triangles.
class RimmedSurface {
 public:
  explicit RimmedSurface(const Mesh&);

  struct Distance {
    double toItself = 0;   // to the surface as it is
    double continued = 0;  // where the nearest point is on the rim, to the plane of the triangle
                           // there; else the same
  };

  /// `near` is TriangleTree's.
  Distance distance(const measure::Vector3& point, uint32_t& near) const;

 private:
  measure::TriangleTree tree_;
  std::vector<uint8_t> rims_;  // by triangle of the mesh: bit i for an edge after corner i that no
                               // other triangle has
};

}  // namespace isostar::native
