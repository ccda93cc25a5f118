#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isostar/isostar.h"
#include "measure/triangle.h"

namespace isostar::measure {

/// A mesh's triangles along a Morton curve, in a complete binary tree of boxes above runs of a few of them.
class TriangleTree {
 public:
  explicit TriangleTree(const Mesh&);

  size_t size() const { return triangles_.size(); }
  Triangle triangle(size_t place) const;  // in the order of the curve: neighbours are near each other

  /// From the point to the surface, exactly. `near` is the place of the nearest triangle: on entry a guess, which saves
  /// time where points follow each other closely. The tree must not be empty.
  double distance(const Vector3& point, uint32_t& near) const;

 private:
  static constexpr size_t kRun = 4;

  struct Box {
    std::array<float, 3> low, high;
    void cover(const Box&);
    double squaredDistance(const Vector3&) const;
  };
  using Corners = std::array<float, 9>;

  void sortAlongCurve();
  void buildBoxes();
  Box boxOfRun(size_t run) const;

  std::vector<Corners> triangles_;
  std::vector<Box> boxes_;  // node n has the children 2n and 2n + 1, the root is 1, the leaves are the last `leaves_`
  size_t leaves_ = 1;
};

}  // namespace isostar::measure
