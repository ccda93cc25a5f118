// Any chunks of a stream that have arrived, with all that they depend on, make a closed surface.
#include <random>

#include "decoder/reconstruction.h"
#include "decoder/stream_heads.h"
#include "grid/chunk.h"
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

using Marks = std::vector<bool>;  // by chunk

/// Are all chunks of the level before marked that a chunk sees?
bool seesMarked(const ChunkGrid<3>& grid, std::size_t chunk, const ChunkGrid<3>& coarser,
                const Lattice<3>& coarserLevel, const Marks& marked) {
  const Chunk<3> own = grid.chunk(chunk);
  Coordinates<3> low, high;
  for (int a = 0; a < 3; ++a) {
    const int32_t first = own.begin[a] - Chunk<3>::kHalo, last = own.end[a] + Chunk<3>::kHalo;
    low[a] = coarser.at(a, std::max(0, first * kBrickSide / 2));
    high[a] = coarser.at(a, std::min(coarserLevel.last[a], last * kBrickSide / 2));
  }
  bool all = true;
  forEachBetween<3>(low, high, [&](const Coordinates<3>& at) {
    const ZOrder<3> order({coarser.count(0), coarser.count(1), coarser.count(2)});
    all = all && marked[order.number(at)];
  });
  return all;
}

/// Random sets of a stream's chunks.
class RandomSets {
 public:
  RandomSets(const Bytes& bytes, unsigned seed) : bytes_(bytes), random_(seed) {
    EXPECT_EQ(heads_.begin(bytes), Error::None);
  }

  /// Decodes another set; `share`: of the chunks on each level.
  std::unique_ptr<Reconstruction> decode(double share) {
    const Header& header = heads_.header();
    auto reconstruction = reconstructionOf(header, {}, kAlone);
    auto at = heads_.start();
    Marks marked(1, true), coarser;
    Lattice<3> coarserLevel;
    for (const LayerHead& head : heads_.indexed()) {
      const Lattice<3> level(header.base<3>().box, header.base<3>().step >> head.level);
      const ChunkGrid<3> grid(level, header.chunkSide);
      if (head.kind == LayerKind::Refinement) {
        const ChunkGrid<3> before(coarserLevel, header.chunkSide);
        coarser = marked;
        marked.assign(head.sections.size(), true);
        for (std::size_t i = 0; i < marked.size() && marked.size() > 1; ++i)
          marked[i] = std::generate_canonical<double, 32>(random_) < share &&
                      seesMarked(grid, i, before, coarserLevel, coarser);
      }
      coarserLevel = level;
      EXPECT_EQ(reconstruction->decode(head, sectionsOf(head, marked, at), false).error,
                Error::None);
    }
    return reconstruction;
  }

 private:
  /// Signs depend on what they see of the level before, geometry on the signs around: without these
  /// it is other geometry.
  std::vector<Reconstruction::Section> sectionsOf(const LayerHead& head, const Marks& marked,
                                                  std::size_t& at) const {
    std::vector<Reconstruction::Section> sections;
    const bool all = std::ranges::all_of(marked, [](bool one) { return one; });
    for (std::size_t i = 0; i < head.sections.size(); ++i) {
      const auto length = static_cast<std::size_t>(head.sections[i]);
      at += checksumBytes(length);
      const bool wanted = head.kind == LayerKind::Refinement ? marked[i] : all;
      sections.push_back({std::span(bytes_).subspan(at, length), wanted});
      at += length;
    }
    return sections;
  }

  static inline const RunTasks kAlone;
  const Bytes& bytes_;
  StreamHeads heads_;
  std::mt19937 random_;
};

TEST(ChunkSets, anySetIsAClosedSurface) {
  const Size size{49, 17, 49};
  for (const auto& field :
       {sampled("gyroid", size, gyroid(25)), sampled("sphere", size, sphere(size, 0.45))}) {
    EncodeOptions options;
    options.chunkSide = 16;
    const Bytes bytes = encoded(field, options);
    RandomSets sets(bytes, 11);
    for (int i = 0; i < 500; ++i) {
      const auto reconstruction = sets.decode(0.3 + 0.7 * (i % 8) / 7);
      Mesh mesh;
      ASSERT_EQ(reconstruction->show(
                    {kPolygonizers[static_cast<std::size_t>(i % 2)], Frame::Grid, false}, mesh),
                Error::None);
      expectSound(mesh, false);
      expectClosed(mesh, size);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace isostar
