// The encoder's plan of displacements: by how much blocks of vertices are to be displaced.
#pragma once

#include "encoder/core/field.h"
#include "estimate/shape_estimate.h"
#include "scalars/crossings.h"
#include "scalars/displacement_window.h"

namespace isostar {

/// Compares, on each crossing axis edge, where the signs locate the surface with where the source's
/// surface is.
template <int D>
class DisplacementPlan {
 public:
  /// `active`: as of activeBricks(signs). Signs and bricks must outlive the plan.
  DisplacementPlan(const GridField<D>& field, const Signs<D>& signs,
                   const std::vector<uint8_t>& active, SmoothingFilter filter);

  struct Next {
    Displacements<D> steps;  // in steps of the pass: for each cube the mean over the edges whose
                             // positive end it holds, stored at the block at its lower corner
    double error;            // before the pass
  };
  /// RMS distance on crossing axis edges, across the surface, in grid steps.
  [[nodiscard]] double error(const Displacements<D>& coded) const;
  /// What a pass should add to the coded displacements.
  [[nodiscard]] Next next(const Displacements<D>& coded, const DisplacementPass& pass) const;
  /// The coded displacements after a pass with these steps.
  [[nodiscard]] Displacements<D> reached(const Displacements<D>& coded,
                                         const Displacements<D>& steps,
                                         const DisplacementPass& pass) const;

 private:
  /// A crossing axis edge, with all that a pass needs of it, so that it is found only once. In
  /// pairs, the even end comes first.
  struct Edge {
    std::array<int32_t, 2> estimates;  // of a ShapeEstimate, at the ends
    std::array<uint16_t, 2> vertices;  // their numbers in the edge's brick; kBeyond: in the next
                                       // brick along the edge's axis
    float crossing;  // from the even end, 0 … 1; -1 minus that if the even end is negative
    uint32_t positiveBrick;
    uint8_t positiveBlock, axis;
  };
  static constexpr uint16_t kBeyond = UINT16_MAX;

  /// An edge without its estimates, which the caller adds.
  [[nodiscard]] static Edge edgeOf(const GridField<D>& field, const Signs<D>& signs,
                                   const EdgeEnds<D>& ends, const Coordinates<D>& brick, int axis);
  /// The displacement at an end, in the unit of a ShapeEstimate.
  [[nodiscard]] static int32_t displacementAt(const DisplacementWindow<D>& displaced,
                                              const Edge& edge, std::size_t end);
  /// Calls visit(edge, error) for each edge. The error says by how many grid steps the surface lies
  /// too near to the positive end.
  template <class Visit>
  void forEachError(const Displacements<D>& coded, Visit visit) const;

  const Signs<D>& signs_;
  const std::vector<uint8_t>& active_;
  std::vector<Edge> edges_;         // in order of brick indices
  std::vector<std::size_t> first_;  // by brick index: its first edge; then the number of all edges
  Displacements<D> blocks_;         // 1 where a block has the positive end of an edge
};

}  // namespace isostar
