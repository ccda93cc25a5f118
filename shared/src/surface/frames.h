// Positions and normals in the frame that a mesh is wanted in: samples or the world.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "grid/lattice.h"
#include "isostar/isostar.h"

namespace isostar {

/// Maps the lattice's vertices to positions in the chosen frame, and gradients to normals.
class Frames {
 public:
  Frames(const Lattice<3>& lattice, const Placement& p, Frame frame)
      : lattice_(lattice), world_(frame == Frame::World) {
    for (int a = 0; a < 3; ++a) {
      origin_[a] = p.origin[a];
      for (int b = 0; b < 3; ++b)
        matrix_[b][a] = p.direction[static_cast<std::size_t>(a * 3 + b)] *
                        p.spacing[static_cast<std::size_t>(b)];
    }
    if (world_) gradient_ = glm::transpose(glm::inverse(matrix_));
  }
  /// The sample at a vertex of the lattice.
  [[nodiscard]] glm::dvec3 sample(const Coordinates<3>& v) const {
    return {lattice_.sample(0, v[0]), lattice_.sample(1, v[1]), lattice_.sample(2, v[2])};
  }
  /// A sample, or a point between samples, in the chosen frame.
  [[nodiscard]] glm::dvec3 position(const glm::dvec3& sample) const {
    return world_ ? origin_ + matrix_ * sample : sample;
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
