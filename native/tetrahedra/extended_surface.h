#pragma once

#include <vector>

#include "measure/triangle_tree.h"

namespace isostar::native {

/// Distances to a surface that is extended beyond its border in the planes of the triangles there.
/// The mesh must have triangles.
class ExtendedSurface {
 public:
  explicit ExtendedSurface(const Mesh&);

  struct Distance {
    double toSurface = 0;
    double toExtension = 0;  // to the triangle's plane if the nearest point is on the border
  };

  /// `near` is a guess as in TriangleTree::distance().
  Distance distance(const measure::Vector3& point, uint32_t& near) const;

 private:
  measure::TriangleTree tree_;
  /// By triangle of the mesh: bit i is set if no other triangle has the edge after corner i.
  std::vector<uint8_t> borderEdges_;
};

}  // namespace isostar::native
