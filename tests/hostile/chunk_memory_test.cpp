// Limits.memory holds for streams in chunks, however many they claim to have.
#include "allocation.h"
#include "coding/codec_state.h"
#include "container/index.h"
#include "property/round_trip.h"
#include "unit/traversal.h"

namespace isostar {
namespace {

constexpr std::size_t kModels = 4u << 20;  // as Limits says

/// The peak while all layers are decoded and the last surface is made.
std::size_t peakOf(const Bytes& bytes, std::size_t memory, Error& error) {
  const Allocation allocation;
  Decoder decoder({.memory = memory});
  decoder.accept(bytes);
  decoder.finish();
  while (decoder.advance()) {
  }
  Mesh mesh;
  error = decoder.mesh({}, mesh);
  if (decoder.error() != Error::None) error = decoder.error();
  return allocation.peak();
}

TEST(ChunkMemory, staysWithinTheLimit) {
  const Size size{70, 61, 57};
  for (const auto& field : {sampled("gyroid", size, gyroid()), sampled("noise", size, noise())}) {
    for (const int side : {16, 32}) {
      EncodeOptions options;
      options.chunkSide = side;
      options.maxError = 0.3;
      const Bytes bytes = encoded(field, options);
      Error error = Error::None;
      const std::size_t whole = peakOf(bytes, SIZE_MAX, error);
      EXPECT_EQ(error, Error::None);
      for (std::size_t memory = whole / 64; memory < whole; memory *= 2) {
        EXPECT_LE(peakOf(bytes, memory, error), memory + kModels + 3 * bytes.size()) << side;
        EXPECT_TRUE(error == Error::None || error == Error::OverLimit) << name(error);
      }
    }
  }
}

TEST(ChunkMemory, manyChunksStayWithinTheLimit) {
  const Size size{130, 100, 115};
  EncodeOptions options;
  options.chunkSide = 16;
  const Bytes bytes = encoded(sampled("gyroid", size, gyroid()), options);
  Error error = Error::None;
  const std::size_t whole = peakOf(bytes, SIZE_MAX, error);
  ASSERT_GT(whole, 30u << 20);  // far more than models take
  for (std::size_t memory = whole / 16; memory < whole; memory += memory / 2) {
    EXPECT_LE(peakOf(bytes, memory, error), memory + kModels + 3 * bytes.size());
    EXPECT_TRUE(error == Error::None || error == Error::OverLimit) << name(error);
  }
}

/// A box without a surface whose levels have as many chunks as the index can name, and a pass over
/// the last one.
Bytes emptyChunks(const Size& size) {
  Header header;
  header.size = {size[0], size[1], size[2], 1};
  header.chunkSide = 16;
  CodecState<3> state(header);
  std::vector<LayerHead> heads;
  std::vector<LayerSections> layers;
  heads.push_back({.kind = LayerKind::Base});
  layers.push_back(
      {coded(state.signs, NoScalars(), [&](auto& exchange) { state.base(exchange); })});
  for (int level = 1; level <= header.finestLevel() && header.chunks(level) < kMostSections;
       ++level) {
    heads.push_back({.kind = LayerKind::Refinement, .level = level});
    LayerSections sections(static_cast<std::size_t>(header.chunks(level)));
    if (sections.size() == 1) {
      const Signs<3> nothing(state.signs.lattice().finer());
      sections[0] = coded(nothing, NoScalars(), [&](auto& exchange) { state.refine(exchange); });
    }
    layers.push_back(std::move(sections));
  }
  heads.push_back({.kind = LayerKind::Exponents, .level = heads.back().level});
  layers.emplace_back(layers.back().size());
  Bytes bytes;
  append(bytes, header, heads, layers);
  return bytes;
}

TEST(ChunkMemory, emptyChunksCountBeforeTheyAreMade) {
  for (const auto& size :
       {Size{200, 200, 200}, Size{1025, 1025, 1025}, Size{1 << 20, 8, 1}, Size{1 << 22, 1, 1}}) {
    const Bytes bytes = emptyChunks(size);
    Error error = Error::None;
    for (const std::size_t memory : {1u << 20, 8u << 20, 64u << 20}) {
      EXPECT_LE(peakOf(bytes, memory, error), memory + kModels + 3 * bytes.size())
          << size[0] << ' ' << memory;
      // Empty chunks are not made: what counts are the index and lists of sections.
      const bool isOver = size[0] > 200 && memory < 64u << 20;
      EXPECT_EQ(error, isOver ? Error::OverLimit : Error::None) << size[0] << ' ' << memory;
    }
  }
  const Decoder decoder = decoderOf(emptyChunks({70, 70, 70}));
  EXPECT_TRUE(decoder.isFinal());
  EXPECT_EQ(decoder.level() + 1, decoder.levels());
}

}  // namespace
}  // namespace isostar
