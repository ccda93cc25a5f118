#pragma once

#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// Boxes around a mesh's tetrahedra, for finding those at a point.
class TetrahedronTree {
 public:
  explicit TetrahedronTree(const TetrahedralMesh&);

  /// Calls `visit(tetrahedron)` for each whose box holds the point, until one returns true.
  template <class Visit>
  void visit(const measure::Vector3& point, Visit&& visit) const {
    std::array<uint32_t, 64> waiting{};  // one a level: the tree is balanced
    for (size_t count = 1; count > 0;) {
      const Node& node = nodes_[waiting[--count]];
      if (!node.holds(point)) continue;
      if (node.count == 0) {
        waiting[count++] = node.first + 1;
        waiting[count++] = node.first;
        continue;
      }
      for (uint32_t i = node.first; i < node.first + node.count; ++i)
        if (visit(order_[i])) return;
    }
  }

 private:
  struct Node {
    std::array<double, 3> low, high;
    uint32_t first = 0, count = 0;  // of tetrahedra in order_; count 0: the first of two nodes

    bool holds(const measure::Vector3& p) const {
      return p.x >= low[0] && p.y >= low[1] && p.z >= low[2] && p.x <= high[0] && p.y <= high[1] &&
             p.z <= high[2];
    }
  };

  void build(const TetrahedralMesh&, uint32_t node, uint32_t first, uint32_t last);

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace isostar::native
