// Positions and normals in the frame that a mesh is wanted in: samples or the world.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "grid/lattice.h"
#include "isostar/isostar.h"

namespace isostar {

/// By how much a step along each axis of the samples moves in the world.
[[nodiscard]] inline glm::dmat3 stepsOf(const Placement& placement) {
  glm::dmat3 steps;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b)
      steps[b][a] = placement.direction[static_cast<std::size_t>(a * 3 + b)] *
                    placement.spacing[static_cast<std::size_t>(b)];
  }
  return steps;
}
/// The place among the samples of a point in a frame.
[[nodiscard]] inline glm::dvec3 sampleAt(const Placement& placement, Frame frame,
                                         const glm::dvec3& point) {
  if (frame == Frame::Grid) return point;
  const auto& [x, y, z] = placement.origin;
  return glm::inverse(stepsOf(placement)) * (point - glm::dvec3(x, y, z));
}

/// Maps the lattice's vertices to positions in the chosen frame, and gradients to normals.
class Frames {
 public:
  Frames(const Lattice<3>& lattice, const Placement& p, Frame frame)
      : lattice_(lattice), world_(frame == Frame::World) {
    if (!world_) return;
    matrix_ = stepsOf(p);
    for (int a = 0; a < 3; ++a) origin_[a] = p.origin[static_cast<std::size_t>(a)];
    gradient_ = glm::transpose(glm::inverse(matrix_));
  }
  /// What a plane of the lattice adds to the position of a vertex on it, in the chosen frame. Axis
  /// 0 adds the origin, too.
  [[nodiscard]] glm::dvec3 part(int axis, int32_t plane) const {
    const double sample = lattice_.sample(axis, plane);
    const glm::dvec3 part = matrix_[axis] * sample;
    return axis == 0 ? origin_ + part : part;
  }
  /// A gradient by samples as one in the chosen frame, of any length.
  [[nodiscard]] glm::dvec3 normal(const glm::dvec3& gradient) const {
    return world_ ? gradient_ * gradient : gradient;
  }
  /// Does the frame reverse orientation?
  [[nodiscard]] bool mirrors() const { return world_ && glm::determinant(matrix_) < 0; }

 private:
  Lattice<3> lattice_;
  bool world_;
  glm::dvec3 origin_{};
  glm::dmat3 matrix_{1.0}, gradient_{1.0};
};

}  // namespace isostar
