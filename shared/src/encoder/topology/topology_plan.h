// The plan of which cells each level may keep without a change of the surface's topology (§4.3).
#pragma once

#include <vector>

#include "bisection/diamond.h"
#include "grid/signs.h"

namespace isostar {

/// A vertex must not be welded if it is a new vertex whose weld would change the topology
/// (weld_topology.h), if such a vertex of a finer level depends on it, or if a caller has forbidden
/// it. The topology depends on the signs of the vertex's diamond, and these do not change as long
/// as vertices are welded from the finest level on. So it is known in advance which cells may be
/// kept: those that touch no such vertex. Where the box's end is no multiple of the grid step,
/// levels do not nest; cells there are split if the surface touches them.
template <int D>
class TopologyPlan {
 public:
  /// `actual`: the source's signs by level; they must outlive the plan.
  explicit TopologyPlan(const std::vector<Signs<D>>& actual);

  /// By level: the centres, on its lattice, of those cells of the next coarser level that are kept.
  /// The first entry is empty.
  [[nodiscard]] const std::vector<Signs<D>>& centres() const { return centres_; }
  /// Splits the coarsest kept cells around a vertex of the finest level, within `reach` times their
  /// size, from `level` on. False if there are none.
  bool forbid(const Coordinates<D>& v, int level, double reach);
  /// Finds the kept cells again. Required after forbid().
  void update();

 private:
  [[nodiscard]] int finestLevel() const { return static_cast<int>(actual_.size()) - 1; }
  [[nodiscard]] bool keepsTopology(int level, const Coordinates<D>& v) const;
  void pinParents(const Signs<D>& bad, Signs<D>& parents) const;
  [[nodiscard]] Signs<D> wholeCells(int level, const Signs<D>& bad) const;

  const std::vector<Signs<D>>& actual_;
  std::vector<Signs<D>> changing_;   // new vertices whose weld would change the topology
  std::vector<Signs<D>> forbidden_;  // centres of cells
  std::vector<Signs<D>> centres_;
};

}  // namespace isostar
