// In which order tasks code the chunks of a level.
#pragma once

#include <algorithm>
#include <vector>

#include "grid/chunk.h"

namespace isostar {

/// The numbers of a level's chunks, those first that own most bricks of both signs: tasks that run
/// side by side then end at about the same time. `side`: of a chunk, in cells.
template <int D>
[[nodiscard]] std::vector<std::size_t> largestFirst(const Signs<D>& level, int32_t side) {
  const ChunkGrid<D> grid(level.lattice(), side);
  std::vector<std::size_t> bricks(grid.total()), order(grid.total());
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    order[i] = i;
    forEachBrickOf(grid.chunk(i), level.table(), [&](std::size_t brickIndex) {
      bricks[i] += level.slot(brickIndex) > Signs<D>::kPositive ? 1 : 0;
    });
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return bricks[a] > bricks[b]; });
  return order;
}

}  // namespace isostar
