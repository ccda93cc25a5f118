// Streams of so many chunks that their index has pages.
#include "container/index.h"
#include "decoder/stream_heads.h"
#include "golden/golden_sources.h"
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

Bytes inChunks(const SampledField& field, EncodeOptions options = {}) {
  options.chunkSide = 16;
  return encoded(field, options);
}

/// 8 × 8 × 9 chunks of 16 cells.
SampledField gyroidInPages() {
  return sampled("gyroid", {129, 129, 145}, gyroid(41));
}

TEST(IndexPages, longLayersHaveThem) {
  const Bytes bytes = inChunks(golden::twoBalls("balls"));
  StreamHeads heads;
  ASSERT_EQ(heads.begin(bytes), Error::None);
  EXPECT_LT(heads.start(), bytes.size() / 3);
  std::size_t several = 0;
  for (const LayerHead& head : heads.indexed()) {
    const auto chunks = heads.header().chunks(head.level);
    several += head.pages.size() == 2 ? 1 : 0;
    EXPECT_EQ(head.pages.size(), chunks > kChunksPerPage ? 2u : 0u);
    EXPECT_EQ(head.sections.size(), chunks > kChunksPerPage ? 0u : chunks);
  }
  EXPECT_GT(several, 1u);
}

TEST(IndexPages, surfacesAreThoseOfTheSource) {
  for (const auto& field : {golden::twoBalls("balls"), gyroidInPages()}) {
    EncodeOptions options;
    options.lossless = true;
    const MeshOptions shown{Polygonizer::Cubes, Frame::Grid, true};
    SCOPED_TRACE(described(field));
    expectSameMesh(decoded(inChunks(field, options), shown), sourceMesh(field, shown), 1e-4);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(IndexPages, prefixesShowSoundClosedSurfaces) {
  for (const auto& field : {golden::twoBalls("balls"), gyroidInPages()}) {
    const Bytes bytes = inChunks(field);
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 12) {
      const Decoder decoder = decoderOf(std::span(bytes).first(length));
      ASSERT_EQ(decoder.error(), Error::Truncated);
      if (!decoder.ready()) continue;
      const Mesh mesh = meshOf(decoder, {Polygonizer::Tetrahedra, Frame::Grid, true});
      expectSound(mesh);
      expectClosed(mesh, field.size);
    }
  }
}

TEST(IndexPages, damagedOnesAreCorruptAtTheirTurn) {
  const Bytes bytes = inChunks(golden::twoBalls("balls"));
  StreamHeads heads;
  ASSERT_EQ(heads.begin(bytes), Error::None);
  std::size_t at = heads.start();
  for (const LayerHead& head : heads.indexed()) {
    for (std::size_t i = 0; i < pageBytes(head); i += 5) {
      Bytes damaged = bytes;
      damaged[at + i] ^= std::byte{4};
      for (const bool isRegion : {false, true}) {
        Decoder decoder;
        if (isRegion) {
          EXPECT_EQ(decoder.setRegion({{0, 0, 0}, {9, 9, 70}, Frame::Grid}), Error::None);
        }
        decoder.accept(damaged);
        while (decoder.advance()) {
        }
        EXPECT_TRUE(decoder.error() == Error::Corrupt || isRegion);
        EXPECT_GE(decoder.level() + 2, decoder.levels());
      }
    }
    at += static_cast<std::size_t>(pageBytes(head) + head.bytes);
  }
}

}  // namespace
}  // namespace isostar
