#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isostar/isostar.h"
#include "measure/triangle.h"

namespace isostar::measure {

/// A mesh's triangles along a Morton curve, in a complete tree of boxes above runs of a few of
/// them.
class TriangleTree {
 public:
  explicit TriangleTree(const Mesh&);

  size_t size() const { return triangles_.size(); }
  Triangle triangle(
      size_t place) const;  // in the order of the curve: neighbours are near each other
  uint32_t index(size_t place) const { return order_[place]; }  // in the mesh

  /// From the point to the surface, exactly. `near` is the place of the nearest triangle: on entry
  /// a guess, which saves time where points follow each other closely. The tree must not be empty.
  double distance(const Vector3& point, uint32_t& near) const;

 private:
  static constexpr size_t kRun = 4, kFan = 4;

  /// Four numbers that the processor computes with at once.
  using Lanes = float __attribute__((vector_size(kFan * sizeof(float))));

  /// The boxes of a node's children, side by side. They are a little too large, so that distances
  /// to them, in single precision, are never too long.
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
  std::vector<Fan> fans_;  // node n has the children 4n + 1 … 4n + 4; nodes from fans_.size() on
                           // are runs of triangles
};

}  // namespace isostar::measure
