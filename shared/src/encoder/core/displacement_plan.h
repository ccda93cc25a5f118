// Only the encoder's: how far blocks of vertices are to be displaced.
#pragma once

#include "encoder/core/field.h"
#include "estimate/shape_estimate.h"
#include "scalars/crossings.h"
#include "scalars/displacement_window.h"

namespace isostar {

/// Compares where the signs put the source's surface on each crossing axis edge, and where it is.
template <int D>
class DisplacementPlan {
 public:
  /// Signs and bricks are borrowed; `active` as of activeBricks(signs).
  DisplacementPlan(const GridField<D>& field, const Signs<D>& signs,
                   const std::vector<uint8_t>& active, SmoothingFilter filter);

  struct Next {
    Displacements<D> steps;  // of the pass: for each cube the mean over the edges with their
                             // positive end in it, at the block at its lower corner
    double error;            // before it
  };
  /// RMS distance across the surface on crossed axis edges, grid steps.
  [[nodiscard]] double error(const Displacements<D>& coded) const;
  /// What a pass should add to what has been told.
  [[nodiscard]] Next next(const Displacements<D>& coded, const DisplacementPass& pass) const;
  /// What will have been told after a pass with such steps.
  [[nodiscard]] Displacements<D> reached(const Displacements<D>& coded,
                                         const Displacements<D>& steps,
                                         const DisplacementPass& pass) const;

 private:
  /// A crossing axis edge; of pairs the one of the even end comes first. All that passes ask of it,
  /// so that each need not find it anew.
  struct Edge {
    std::array<int32_t, 2> estimates;  // of a ShapeEstimate at its ends
    std::array<uint16_t, 2> vertices;  // in its brick; kBeyond: in the next one along its axis
    float crossing;  // from the even end, 0 … 1; -1 less that if the even end is negative
    uint32_t positivePosition;
    uint8_t positiveBlock, axis;
  };
  static constexpr uint16_t kBeyond = UINT16_MAX;

  /// Its estimates are still to come.
  [[nodiscard]] static Edge edgeOf(const GridField<D>& field, const Signs<D>& signs,
                                   const EdgeEnds<D>& ends, const Coordinates<D>& brick, int axis);
  /// By how many units of a ShapeEstimate an end is displaced.
  [[nodiscard]] static int32_t displacementAt(const DisplacementWindow<D>& displaced,
                                              const Edge& edge, std::size_t end);
  /// Calls visit(edge, by how many steps the surface lies too near to its positive end) for each.
  template <class Visit>
  void forEachError(const Displacements<D>& coded, Visit visit) const;

  const Signs<D>& signs_;
  const std::vector<uint8_t>& active_;
  std::vector<Edge> edges_;         // brick by brick
  std::vector<std::size_t> first_;  // of each place, and the end of the last
  Displacements<D> blocks_;         // 1 where a block has a positive end of one
};

}  // namespace isostar
