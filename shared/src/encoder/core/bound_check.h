// Checks the bound: how far the vertices of the surface coded so far are from the source's.
#pragma once

#include "encoder/core/brick_tasks.h"
#include "encoder/core/source_distance.h"

namespace isostar {

/// Keeps what it has measured, so that only what changes is measured again.
template <int D>
class BoundCheck {
 public:
  /// All must outlive it.
  BoundCheck(const GridField<D>& field, const Header& header, const RunTasks& runTasks)
      : field_(field), header_(header), runTasks_(runTasks) {}

  /// Marks, by brick index, the bricks with an end of an edge on which a vertex of the finest
  /// surface is off by more than the bound. Empty if there are none. All scalars must be known.
  /// `changed`: marks, by brick index, the bricks whose scalars may have changed since the last
  /// call, which had the same bound; empty: all.
  [[nodiscard]] std::vector<uint8_t> beyond(double bound, const Signs<D>& signs,
                                            const Scalars<D>& scalars,
                                            const std::vector<uint8_t>& active,
                                            const std::vector<uint8_t>& changed = {});
  /// The largest distance of a vertex of the finest surface from the source's on the same edge, as
  /// of the last call of beyond(). Both surfaces have the same polygons over these vertices, so
  /// that no point of either is farther from the other.
  [[nodiscard]] double largest() const;

 private:
  [[nodiscard]] std::vector<std::size_t> measure(double bound, const Signs<D>& signs,
                                                 const Scalars<D>& scalars,
                                                 const std::vector<uint8_t>& marked,
                                                 const BrickRange& range);

  const GridField<D>& field_;
  const Header& header_;
  const RunTasks& runTasks_;
  std::vector<double> farthest_;  // by brick index: the largest distance on the brick's edges
};

}  // namespace isostar
