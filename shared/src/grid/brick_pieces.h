// Parts of a table of bricks, for tasks that work side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isostar {

/// Consecutive brick indices: first … end - 1.
struct BrickRange {
  std::size_t first, end;
};

/// Divides all brick indices into ranges with about equally many marked bricks. The ranges depend
/// on the marks alone, and not on how many tasks run at once. `marked`: by brick index.
[[nodiscard]] inline std::vector<BrickRange> brickPieces(const std::vector<uint8_t>& marked) {
  constexpr std::size_t kFewestBricks = 128, kMostPieces = 64;
  const auto isMarked = [](uint8_t mark) { return mark != 0; };
  const auto count =
      static_cast<std::size_t>(std::count_if(marked.begin(), marked.end(), isMarked));
  const std::size_t most =
      count / std::clamp<std::size_t>(count / kFewestBricks, 1, kMostPieces) + 1;
  std::vector<BrickRange> pieces{{0, 0}};
  std::size_t inPiece = 0;
  for (std::size_t brickIndex = 0; brickIndex < marked.size(); ++brickIndex) {
    if (!isMarked(marked[brickIndex]) || ++inPiece <= most) continue;
    pieces.back().end = brickIndex;
    pieces.push_back({brickIndex, brickIndex});
    inPiece = 1;
  }
  pieces.back().end = marked.size();
  return pieces;
}

}  // namespace isostar
