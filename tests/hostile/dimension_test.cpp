// Damaged streams of images and of sequences: the other dimensions of the same templates.
#include <random>

#include "harmless.h"
#include "property/sampled_image.h"
#include "stream_layout.h"

namespace isostar {
namespace {

std::vector<Bytes> goodStreams() {
  const SampledImage image = imagesOf({13, 10})[3];
  EncodeOptions options;
  options.maxError = 0.1;
  std::vector<Bytes> streams{encoded(image, options)};
  options.polygonizer = Polygonizer::Tetrahedra;
  streams.push_back(encoded(imagesOf({6, 7})[4], options));
  std::vector<float> samples;
  for (int i = 0; i < 4 * 5 * 3 * 3; ++i) samples.push_back(static_cast<float>(noise(8)(i, 0, 0)));
  options.polygonizer = Polygonizer::Cubes;
  streams.emplace_back();
  EXPECT_EQ(encode(Sequence{samples, {4, 5, 3}, 3, {}}, options, streams.back()), Error::None);
  return streams;
}

TEST(HostileDimensions, flippedBitsAreHarmless) {
  for (const Bytes& good : goodStreams()) {
    const StreamLayout layout(good);
    Bytes bad = good;
    for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
      SCOPED_TRACE("bit " + std::to_string(bit % 8) + " of byte " + std::to_string(bit / 8));
      bad[bit / 8] ^= std::byte{1} << (bit % 8);
      (void)harmlesslyDecoded(bad);
      (void)harmlesslyDecoded(repaired(bad, layout));
      bad[bit / 8] ^= std::byte{1} << (bit % 8);
    }
  }
}

TEST(HostileDimensions, noiseIsHarmless) {
  std::mt19937_64 random(4);
  for (const int dimension : {2, 4}) {
    for (const Coordinates<4>& size :
         {Coordinates<4>{9, 9, 9, 9}, {1 << 10, 1 << 10, 1, 2}, {2, 3, 40, 1}, {60, 5, 30, 20}}) {
      Header header;
      header.dimension = dimension;
      header.size = size;
      header.countWhole(1);
      Layers layers;
      for (int level = 0; level <= header.finestLevel() + 4; ++level) {
        const int further = level - header.finestLevel();
        const LayerKind kind = level == 0     ? LayerKind::Base
                               : further <= 0 ? LayerKind::Refinement
                               : further == 1 ? LayerKind::Displacement
                                              : LayerKind::Exponents;
        Bytes payload(100);
        for (std::byte& b : payload) b = static_cast<std::byte>(random());
        if (kind == LayerKind::Displacement) payload[0] = std::byte{63 * 4 + 1};
        if (kind == LayerKind::Exponents) payload[0] = static_cast<std::byte>(level & 1);
        layers.push_back({{kind, std::min(level, header.finestLevel()), 0.1, 0, 0}, payload});
      }
      (void)harmlesslyDecoded(assembled(header, layers));
    }
  }
}

TEST(HostileDimensions, surfacesAreOfTheStreamsDimension) {
  Header header;
  header.dimension = 4;
  header.size = {9, 9, 9, 9};
  for (const bool adaptive : {false, true}) {
    header.adaptive = adaptive;
    header.keepsTopology = !adaptive;
    const Decoder decoder = harmlesslyDecoded(assembled(header, {}));
    EXPECT_EQ(decoder.error(), Error::UnsupportedVersion);
    EXPECT_FALSE(decoder.ready());
    EXPECT_EQ(decoder.info().dimension, 4);
  }
}

}  // namespace
}  // namespace isostar
