// Only the encoder's: how far blocks of vertices are to be displaced.
#pragma once

#include "displacements.h"
#include "field.h"
#include "scalars.h"
#include "shape_estimate.h"

namespace isostar {

/// Compares where the signs put the source's surface on each crossing axis edge, and where it is.
template <int D>
class DisplacementPlan {
 public:
  /// Signs and bricks are borrowed; `active` as of activeBricks(signs).
  DisplacementPlan(const GridField<D>& field, const Signs<D>& signs, const std::vector<uint8_t>& active, Kernel kernel);

  struct Next {
    Displacements<D> steps;  // of the pass: for each cube the mean over the edges with their positive end in it, at the block at
                             // its lower corner
    double error;            // before it
  };
  /// RMS distance across the surface on crossed axis edges, grid steps.
  [[nodiscard]] double error(const Displacements<D>& told) const;
  /// What a pass should add to what has been told.
  [[nodiscard]] Next next(const Displacements<D>& told, const DisplacementPass& pass) const;
  /// What will have been told after a pass with such steps.
  [[nodiscard]] Displacements<D> reached(const Displacements<D>& told, const Displacements<D>& steps, const DisplacementPass& pass) const;

 private:
  /// Calls visit(positive end, by how many steps the surface lies too near to it) for each crossing axis edge.
  template <class Visit>
  void forEachError(const Displacements<D>& told, Visit visit) const;

  const Signs<D>& signs_;
  const std::vector<uint8_t>& active_;
  Scalars<D> estimates_;          // of a ShapeEstimate, at the ends of crossing axis edges
  std::vector<float> crossings_;  // where each edge is crossed, from its even end, 0 … 1; -1 less that if the even end is negative
  Displacements<D> blocks_;       // 1 where a block has a positive end of one
};

}  // namespace isostar
