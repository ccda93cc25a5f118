#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isostar/isostar.h"
#include "measure/triangle.h"

namespace isostar::measure {

/// A mesh's triangles in the order of a Morton curve, in a complete tree of bounding boxes. A leaf
/// is a run of a few triangles.
class TriangleTree {
 public:
  explicit TriangleTree(const Mesh&);

  size_t size() const { return triangles_.size(); }
  /// `position` counts in the order of the curve.
  Triangle triangle(size_t position) const;
  uint32_t index(size_t position) const { return order_[position]; }  // in the mesh

  /// The exact distance from the point to the surface. `near` is the position of the nearest
  /// triangle: on entry a guess, which saves time for a sequence of close points. The tree must not
  /// be empty.
  double distance(const Vector3& point, uint32_t& near) const;

 private:
  static constexpr size_t kRun = 4, kFan = 4;

  /// Four numbers in one vector register.
  using Lanes = float __attribute__((vector_size(kFan * sizeof(float))));

  /// The boxes of a node's four children. They are slightly enlarged, so that distances to them in
  /// single precision are lower bounds.
  struct Fan {
    std::array<Lanes, 3> low, high;
    Lanes squaredDistances(const std::array<float, 3>&) const;
  };
  struct Box {
    std::array<float, 3> low, high;
  };
  using Corners = std::array<float, 9>;

  void sortAlongCurve();
  void buildFans();
  Box boxOfRun(size_t run) const;
  Box boxAround(const Fan&) const;
  void searchRun(size_t run, const Vector3& point, double& best, uint32_t& near) const;

  std::vector<Corners> triangles_;
  std::vector<uint32_t> order_;
  /// Node n has the children 4n + 1 … 4n + 4; nodes from fans_.size() on are runs of triangles.
  std::vector<Fan> fans_;
};

}  // namespace isostar::measure
