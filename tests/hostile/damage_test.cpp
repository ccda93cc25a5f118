// Streams with one changed bit, with the old checksums and with repaired ones.
#include "harmless.h"
#include "stream_layout.h"

namespace isostar {
namespace {

std::vector<SampledField> smallFields() {
  const Size size{9, 8, 10};
  return {sampled("sphere", size, sphere(size)),
          sampled("whole numbers", {5, 4, 6}, [](double x, double y, double z) {
            return std::round(100 * gyroid(7)(x, y, z));
          })};
}

template <class Visit>
void forEachFlip(const Bytes& bytes, Visit visit) {
  Bytes flipped = bytes;
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    flipped[bit / 8] ^= std::byte{1} << (bit % 8);
    visit(flipped, bit);
    flipped[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

TEST(Damage, aChangedBitIsDetectedOrChangesNoSurface) {
  for (const auto& field : smallFields()) {
    const Bytes good = encoded(field);
    const Mesh expected = decoded(good);
    forEachFlip(good, [&](const Bytes& bytes, std::size_t bit) {
      const Decoder decoder = harmlesslyDecoded(bytes);
      if (decoder.error() != Error::None) return;
      const Mesh mesh = meshOf(decoder);
      EXPECT_TRUE(mesh.indices == expected.indices && mesh.positions == expected.positions)
          << described(field) << ", bit " << bit % 8 << " of byte " << bit / 8;
    });
  }
}

void expectHarmlessFlips(const SampledField& field, const EncodeOptions& options) {
  const Bytes good = encoded(field, options);
  const StreamLayout layout(good);
  forEachFlip(good, [&](const Bytes& bytes, std::size_t bit) {
    SCOPED_TRACE("bit " + std::to_string(bit % 8) + " of byte " + std::to_string(bit / 8));
    (void)harmlesslyDecoded(repaired(bytes, layout));
  });
}

TEST(Damage, isHarmlessWithRepairedChecksums) {
  EncodeOptions options;
  options.maxError = 0.1;
  expectHarmlessFlips(smallFields()[0], options);
  options.lossless = true;
  options.polygonizer = Polygonizer::Tetrahedra;
  expectHarmlessFlips(smallFields()[1], options);
}

TEST(Damage, isHarmlessInFurtherIsovalues) {
  EncodeOptions options;
  options.maxError = 0.1;
  options.furtherIsovalues = {0.3, -0.2};
  expectHarmlessFlips(smallFields()[0], options);
  options.furtherIsovalues = {3};
  expectHarmlessFlips(smallFields()[1], options);
}

TEST(Damage, isHarmlessInFittedScalars) {
  EncodeOptions options;
  options.maxError = 0.02;
  options.effort = 2;
  expectHarmlessFlips(smallFields()[0], options);
  options.polygonizer = Polygonizer::Tetrahedra;
  options.lossless = true;
  expectHarmlessFlips(smallFields()[1], options);
}

TEST(Damage, isHarmlessInADomain) {
  const SampledField field = within(halfSpace({0.6, 0.48, 0.64}, 7.3), smallFields()[0]);
  EncodeOptions options;
  options.maxError = 0.1;
  expectHarmlessFlips(field, options);
  options.polygonizer = Polygonizer::Tetrahedra;
  options.lossless = true;
  expectHarmlessFlips(
      within([](double x, double y, double z) { return noise(7)(x, y, z); }, smallFields()[1]),
      options);
}

TEST(Damage, aDamagedLayerLeavesTheLayersBeforeIt) {
  const auto field = smallFields()[0];
  const Bytes good = encoded(field);
  const StreamLayout layout(good);
  for (std::size_t i = 1; i < layout.layers.size(); ++i) {
    if (layout.layers[i].end == layout.layers[i].payload) continue;
    Bytes bad = good;
    bad[layout.layers[i].payload] ^= std::byte{1};
    const Decoder decoder = harmlesslyDecoded(bad),
                  before = decoderOf(std::span(good).first(layout.layers[i - 1].end));
    EXPECT_EQ(decoder.error(), Error::Corrupt);
    EXPECT_EQ(decoder.bytes(), layout.layers[i - 1].end);
    EXPECT_EQ(meshOf(decoder).positions, meshOf(before).positions);
  }
}

TEST(Damage, removedBytesAreDetected) {
  const Bytes good = encoded(smallFields()[0]);
  for (std::size_t at = 0; at < good.size(); ++at) {
    Bytes bad = good;
    bad.erase(bad.begin() + static_cast<std::ptrdiff_t>(at));
    EXPECT_NE(harmlesslyDecoded(bad).error(), Error::None) << "byte " << at;
  }
}

}  // namespace
}  // namespace isostar
