#include "grid/brick_pieces.h"

#include <gtest/gtest.h>

#include <random>

namespace isostar {
namespace {

TEST(BrickPieces, areAllBricksInOrderWithAboutEquallyManyMarkedOnes) {
  std::mt19937 random(3);
  for (const std::size_t total : {0, 1, 100, 128, 129, 1000, 50000}) {
    for (const unsigned oneIn : {1u, 7u, 1000u}) {
      std::vector<uint8_t> marked(total);
      for (uint8_t& mark : marked) mark = random() % oneIn == 0 ? 1 : 0;
      const auto all = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
      const auto pieces = brickPieces(marked);
      std::size_t end = 0;
      for (const BrickRange& piece : pieces) {
        EXPECT_EQ(piece.first, end);
        end = piece.end;
        const auto inPiece = std::count(marked.begin() + static_cast<std::ptrdiff_t>(piece.first),
                                        marked.begin() + static_cast<std::ptrdiff_t>(piece.end), 1);
        EXPECT_LE(static_cast<std::size_t>(inPiece), all / pieces.size() + 128);
      }
      EXPECT_EQ(end, total);
      EXPECT_LE(pieces.size(), 64u);
      EXPECT_GE(pieces.size(), std::min<std::size_t>(32, all / 256));
    }
  }
}

}  // namespace
}  // namespace isostar
