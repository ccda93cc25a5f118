// Work on the marked bricks of a level, in tasks that may run side by side.
#pragma once

#include "grid/brick_pieces.h"
#include "isostar/isostar.h"
#include "util/run_all.h"

namespace isostar {

/// The results of work(range) for all ranges of brickPieces(marked), in their order.
template <class Work>
auto ofBrickPieces(const std::vector<uint8_t>& marked, const RunTasks& runTasks, Work work) {
  const auto pieces = brickPieces(marked);
  std::vector<decltype(work(pieces.front()))> results(pieces.size());
  runAll(runTasks, pieces.size(), [&](std::size_t i) { results[i] = work(pieces[i]); });
  return results;
}

}  // namespace isostar
