// Which cells of each octave may stay whole without a change in the surface's topology (§4.3).
#pragma once

#include <vector>

#include "bisection/diamond.h"
#include "grid/signs.h"

namespace isostar {

/// Bad is a fresh vertex whose weld would change the topology (topology.h), one that a bad vertex
/// of a finer octave needs, and one that somebody has forbidden to weld. Signs of a vertex's
/// diamond decide, and those stay what they are as long as vertices go finest octave first. So it
/// is known beforehand which cells may stay whole: those that touch no bad vertex. At an end of the
/// box that is no multiple of the step octaves do not nest, and cells there are split where the
/// surface is.
template <int D>
class TopologyPlan {
 public:
  /// The source's signs by octave; they outlive the plan.
  explicit TopologyPlan(const std::vector<Signs<D>>& actual);

  /// The centres of an octave's cells that stay whole, by octave, on the lattice of the next finer
  /// one; none on the first.
  [[nodiscard]] const std::vector<Signs<D>>& centres() const { return centres_; }
  /// Has the coarsest whole cells around a vertex of the finest octave split, as far as `reach` of
  /// their size, from octave `level` on. False where there are none.
  bool forbid(const Coordinates<D>& v, int level, double reach);
  /// Finds the whole cells once more; to be called after some were forbidden.
  void update();

 private:
  [[nodiscard]] int finestLevel() const { return static_cast<int>(actual_.size()) - 1; }
  [[nodiscard]] bool keepsTopology(int level, const Coordinates<D>& v) const;
  void pinParents(const Signs<D>& bad, Signs<D>& parents) const;
  [[nodiscard]] Signs<D> wholeCells(int level, const Signs<D>& bad) const;

  const std::vector<Signs<D>>& actual_;
  std::vector<Signs<D>> changing_;   // fresh vertices whose weld would change the topology
  std::vector<Signs<D>> forbidden_;  // centres of cells
  std::vector<Signs<D>> centres_;
};

}  // namespace isostar
