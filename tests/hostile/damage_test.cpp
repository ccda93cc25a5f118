// Streams with one changed bit, with the old checksums and with repaired ones.
#include "flipped_bits.h"
#include "golden/golden_table.h"

namespace isostar {
namespace {

std::vector<SampledField> smallFields() {
  const Size size{9, 8, 10};
  return {sampled("sphere", size, sphere(size)),
          sampled("whole numbers", {5, 4, 6}, [](double x, double y, double z) {
            return std::round(100 * gyroid(7)(x, y, z));
          })};
}

TEST(Damage, aChangedBitIsDetected) {
  const auto expectDetected = [](const Bytes& bytes) {
    EXPECT_NE(harmlesslyDecoded(bytes).error(), Error::None);
  };
  for (const auto& field : smallFields()) forEachFlip(encoded(field), 1, expectDetected);
  for (const Bytes& golden : goldenStreams(ISOSTAR_GOLDEN)) forEachFlip(golden, 83, expectDetected);
}

/// Of a stream in chunks.
bool hasRightSections(std::span<const std::byte> bytes, std::size_t start, const Header& header) {
  Index index;
  if (readIndex(bytes, start, header, UINT64_MAX, index) != Error::None) return false;
  Bytes mended(bytes.begin(), bytes.end());
  mendIndex(mended, start, header);
  return std::equal(bytes.begin(), bytes.end(), mended.begin());
}

/// Would a decoder find nothing wrong before it decodes the layers?
bool hasRightChecksums(std::span<const std::byte> bytes) {
  Header header;
  std::size_t at = 0;
  if (read(bytes, header, at) != Error::None || header.bytes > bytes.size() - at) return false;
  bytes = bytes.first(at + static_cast<std::size_t>(header.bytes));
  if (header.chunkSide != 0) return hasRightSections(bytes, at, header);
  for (std::size_t number = 0; at < bytes.size(); ++number) {
    LayerHead head;
    std::size_t used = 0;
    if (read(bytes.subspan(at), header, head, used) != Error::None) return false;
    at += used;
    if (head.bytes > bytes.size() - at) return false;
    const auto layer = bytes.subspan(at, static_cast<std::size_t>(head.bytes));
    if (checksum(head, layer, number) != head.checksum) return false;
    at += layer.size();
  }
  return true;
}

TEST(Damage, noChangedBitOfAGoldenStreamLeavesItsChecksumsRight) {
  for (const Bytes& golden : goldenStreams(ISOSTAR_GOLDEN)) {
    EXPECT_TRUE(hasRightChecksums(golden));
    forEachFlip(golden, 1, [](const Bytes& bytes) { EXPECT_FALSE(hasRightChecksums(bytes)); });
  }
}

TEST(Damage, isHarmlessWithRepairedChecksums) {
  EncodeOptions options;
  options.maxError = 0.1;
  expectHarmlessFlips(encoded(smallFields()[0], options));
  options.lossless = true;
  options.polygonizer = Polygonizer::Tetrahedra;
  expectHarmlessFlips(encoded(smallFields()[1], options));
}

TEST(Damage, isHarmlessInFurtherIsovalues) {
  EncodeOptions options;
  options.maxError = 0.1;
  options.furtherIsovalues = {0.3, -0.2};
  expectHarmlessFlips(encoded(smallFields()[0], options));
  options.furtherIsovalues = {3};
  expectHarmlessFlips(encoded(smallFields()[1], options));
}

TEST(Damage, isHarmlessInFittedScalars) {
  EncodeOptions options;
  options.maxError = 0.02;
  options.effort = 2;
  expectHarmlessFlips(encoded(smallFields()[0], options));
  options.polygonizer = Polygonizer::Tetrahedra;
  options.lossless = true;
  expectHarmlessFlips(encoded(smallFields()[1], options));
}

TEST(Damage, isHarmlessInADomain) {
  const SampledField field = within(halfSpace({0.6, 0.48, 0.64}, 7.3), smallFields()[0]);
  EncodeOptions options;
  options.maxError = 0.1;
  expectHarmlessFlips(encoded(field, options));
  options.polygonizer = Polygonizer::Tetrahedra;
  options.lossless = true;
  expectHarmlessFlips(encoded(within(noise(7), smallFields()[1]), options));
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
