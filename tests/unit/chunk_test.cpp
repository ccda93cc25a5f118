#include "grid/chunk.h"

#include <gtest/gtest.h>

#include "coding/signs/refinement_coder.h"
#include "sign_fields.h"
#include "traversal.h"

namespace isostar {
namespace {

const std::vector<Coordinates<3>> kBoxes{{40, 33, 16}, {31, 64, 65}, {33, 17, 48}, {7, 96, 20}};
constexpr int32_t kSide = 16;

TEST(ChunkGrid, isOneChunkWithoutHaloIfTheLevelIsSmall) {
  const Lattice<3> level({64, 40, 9}, 1);
  const ChunkGrid<3> grid(level, 64);
  ASSERT_EQ(grid.total(), 1u);
  const Chunk<3> chunk = grid.chunk(0);
  EXPECT_EQ(chunk.lattice.last, level.last);
  const auto halo = chunk.halo();
  EXPECT_EQ(std::count(halo.begin(), halo.end(), 1), 0);
}

TEST(ChunkGrid, eachBrickHasOneOwner) {
  for (const auto& box : kBoxes) {
    for (const int32_t step : {1, 2}) {
      const Lattice<3> level(box, step);
      const BrickTable<3> table(level);
      std::vector<int> owners(table.total());
      const ChunkGrid<3> grid(level, kSide);
      for (std::size_t i = 0; i < grid.total(); ++i) {
        const Chunk<3> chunk = grid.chunk(i);
        const BrickTable<3> own(chunk.lattice);
        const auto indices = chunk.indicesIn(table, own, 1);
        const auto halo = chunk.halo();
        for (std::size_t b = 0; b < own.total(); ++b) {
          if (halo[b] == 0) ++owners.at(indices[b]);
        }
      }
      EXPECT_EQ(std::count(owners.begin(), owners.end(), 1), std::ssize(owners));
    }
  }
}

/// The chunk's vertices at its own planes are those of the level.
TEST(ChunkGrid, ownVerticesAreNewOnTheSameAxes) {
  for (const auto& box : kBoxes) {
    const Lattice<3> level(box, 2);
    const ChunkGrid<3> grid(level, kSide);
    for (std::size_t i = 0; i < grid.total(); ++i) {
      const Chunk<3> chunk = grid.chunk(i);
      Coordinates<3> low, high;
      for (int a = 0; a < 3; ++a) {
        low[a] = chunk.begin[a] * kBrickSide;
        high[a] = std::min(chunk.end[a] * kBrickSide - 1, level.last[a]);
      }
      forEachBetween<3>(low, high, [&](const Coordinates<3>& v) {
        Coordinates<3> own;
        for (int a = 0; a < 3; ++a) own[a] = v[a] - chunk.origin[a] * kBrickSide;
        ASSERT_EQ(chunk.lattice.newAxes(own), level.newAxes(v));
      });
    }
  }
}

/// One chunk of a level, from the signs of the next coarser level alone.
struct ChunkSigns {
  ChunkSigns(const Chunk<3>& chunk, const Signs<3>& coarser)
      : halo(chunk.halo()),
        signs(
            refined(cropped(coarser, chunk.coarser(),
                            chunk.indicesIn(coarser.table(), BrickTable<3>(chunk.coarser()), 2)))) {
  }

  template <class Exchange>
  void code(Exchange& exchange) {
    RefinementCoder<3>().code(exchange, signs, nullptr, &halo);
  }

  std::vector<uint8_t> halo;
  Signs<3> signs;
};

TEST(ChunkGrid, chunksDecodeToTheSignsOfTheLevel) {
  for (const auto& box : kBoxes) {
    for (const auto& field : signFields<3>(box)) {
      SCOPED_TRACE(field.name + " in " + testing::PrintToString(box));
      const Lattice<3> level(box, 1);
      const Signs<3> actual = DenseSigns<3>(level, field.positive).bricks();
      const Signs<3> coarser = DenseSigns<3>(Lattice<3>(box, 2), field.positive).bricks();
      const ChunkGrid<3> grid(level, kSide);
      for (std::size_t i = 0; i < grid.total(); ++i) {
        const Chunk<3> chunk = grid.chunk(i);
        const BrickTable<3> own(chunk.lattice);
        const auto indices = chunk.indicesIn(actual.table(), own, 1);
        ChunkSigns encoder(chunk, coarser), decoder(chunk, coarser);
        const auto bytes = coded(cropped(actual, chunk.lattice, indices), NoScalars(),
                                 [&](auto& exchange) { encoder.code(exchange); });
        ASSERT_TRUE(decoded<3>(bytes, [&](auto& exchange) { decoder.code(exchange); }));
        for (std::size_t b = 0; b < own.total(); ++b) {
          ASSERT_EQ(decoder.signs.brickAt(b), encoder.signs.brickAt(b));
          if (decoder.halo[b] != 0) continue;
          forEachBetween<3>(vertexOf<3>(own.brick(b), 0), vertexOf<3>(own.brick(b), 511),
                            [&](const Coordinates<3>& v) {
                              Coordinates<3> whole;
                              for (int a = 0; a < 3; ++a) {
                                whole[a] = v[a] + chunk.origin[a] * kBrickSide;
                                if (whole[a] > level.last[a]) return;
                              }
                              ASSERT_EQ(decoder.signs.at(v), actual.at(whole));
                            });
        }
      }
    }
  }
}

}  // namespace
}  // namespace isostar
