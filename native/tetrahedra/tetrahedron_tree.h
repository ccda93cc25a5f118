#pragma once

#include "tetrahedra/tetrahedral_mesh.h"

namespace isostar::native {

/// A tree of bounding boxes around a mesh's tetrahedra that finds those at a point.
class TetrahedronTree {
 public:
  explicit TetrahedronTree(const TetrahedralMesh&);

  /// Calls visit(tetrahedron) for each tetrahedron whose box contains the point, until a call
  /// returns true.
  template <class Visit>
  void visit(const measure::Vector3& point, Visit&& visit) const {
    std::array<uint32_t, 64> waiting{};  // one per depth of the tree, which is balanced
    for (size_t count = 1; count > 0;) {
      const Node& node = nodes_[waiting[--count]];
      if (!node.contains(point)) continue;
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
    /// A range of tetrahedra in order_; if count is 0, the first of the two child nodes.
    uint32_t first = 0, count = 0;

    bool contains(const measure::Vector3& p) const {
      return p.x >= low[0] && p.y >= low[1] && p.z >= low[2] && p.x <= high[0] && p.y <= high[1] &&
             p.z <= high[2];
    }
  };

  void build(const TetrahedralMesh&, uint32_t node, uint32_t first, uint32_t last);

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace isostar::native
