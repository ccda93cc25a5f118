// The encoder's plan of displacements: by how much blocks of vertices are to be displaced.
#pragma once

#include "encoder/core/brick_tasks.h"
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
  /// `active`: as of activeBricks(signs). Signs, bricks and `runTasks` must outlive the plan.
  DisplacementPlan(const GridField<D>& field, const Signs<D>& signs,
                   const std::vector<uint8_t>& active, SmoothingFilter filter,
                   const RunTasks& runTasks);

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
    std::array<int16_t, 2> estimates;  // of a ShapeEstimate, at the ends
    std::array<uint16_t, 2> vertices;  // their numbers in the edge's brick; kBeyond: in the next
                                       // brick along the edge's axis
    float crossing;         // from the even end, 0 … 1; -1 minus that if the even end is negative
    uint32_t positiveSlot;  // of the brick of the positive end
    uint8_t positiveBlock, axis;
  };
  static constexpr uint16_t kBeyond = UINT16_MAX;

  /// The edges of a range of bricks, in order of brick indices.
  struct Piece {
    BrickRange range;
    std::vector<std::size_t> first;  // by brick of the range: its first edge; then their number
    std::vector<Edge> edges;
  };
  /// 1 for a block that has the positive end of an edge.
  using Blocks = std::array<uint8_t, Displacements<D>::kBlocks>;
  /// A ShapeEstimate at the ends of a brick's edges.
  using Estimates = std::array<int16_t, power(kBrickSide, D)>;

  /// Finds the estimates, by slot, and the blocks of the active bricks of a range.
  void estimate(const BrickRange& range, SmoothingFilter filter, Estimates* estimates);
  [[nodiscard]] Piece pieceOf(const BrickRange& range, const GridField<D>& field,
                              const Estimates* estimates) const;
  [[nodiscard]] Edge edgeOf(const GridField<D>& field, const EdgeEnds<D>& ends,
                            const Coordinates<D>& brick, int axis,
                            const Estimates* estimates) const;
  /// The displacement at an end, in the unit of a ShapeEstimate.
  [[nodiscard]] static int32_t displacementAt(const DisplacementWindow<D>& displaced,
                                              const Edge& edge, std::size_t end);
  /// By how many grid steps the surface lies too near to the positive end of each edge of a piece.
  [[nodiscard]] std::vector<double> errorsOf(const Piece& piece,
                                             const Displacements<D>& coded) const;
  /// The same for all pieces.
  [[nodiscard]] std::vector<std::vector<double>> errorsBy(const Displacements<D>& coded) const;

  const Signs<D>& signs_;
  const std::vector<uint8_t>& active_;
  const RunTasks& runTasks_;
  std::vector<uint32_t> slot_;  // by brick index: the number of an active brick among these
  std::vector<Blocks> blocks_;  // by slot
  std::vector<Piece> pieces_;
};

}  // namespace isostar
