// Displacements that no encoder writes: any cubes and steps, any number of passes in any order, in
// each dimension.
#include "forged_streams.h"
#include "harmless.h"

namespace isostar {
namespace {

/// A small box with `dimension` axes.
Header boxOf(int dimension) {
  Header header;
  header.dimension = dimension;
  header.size = dimension == 2   ? std::array{30, 21, 1, 1}
                : dimension == 3 ? std::array{17, 12, 22, 1}
                                 : std::array{9, 12, 7, 6};
  header.countWhole(1);
  return header;
}

/// The kinds of stream that may have displacements.
std::vector<Header> headersOf(int dimension) {
  std::vector<Header> headers(2, boxOf(dimension));
  headers[1].furtherIsovalues = {3, -100};
  if (dimension == 4) return headers;
  headers.push_back(boxOf(dimension));
  headers.back().keepsTopology = true;
  if (dimension == 2) return headers;
  headers.push_back(boxOf(dimension));
  headers.back().trimmed = true;
  return headers;
}

template <int D>
GeometryPass<D> anyPass(std::mt19937_64& random, bool displaced) {
  const auto below = [&](uint64_t end) { return static_cast<int>(random() % end); };
  GeometryPass<D> pass;
  pass.kind = displaced && below(2) == 0 ? LayerKind::Displacement
              : below(2) == 0            ? LayerKind::Exponents
                                         : LayerKind::Magnitudes;
  pass.members = static_cast<Members>(below(2));
  pass.exponentRange = below(6);
  pass.allowed.fill(static_cast<uint32_t>(1 << below(20)));
  pass.allowed[0] = 0;
  pass.most = below(33);
  pass.selective = below(2) == 0;
  pass.displacement = {1 + below(3), 1 + below(63)};
  return pass;
}

template <int D>
Bytes anyStream(const Header& header, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<GeometryPass<D>> passes(seed % 9), further(seed % 3);
  for (auto& pass : passes) pass = anyPass<D>(random, true);
  for (auto& pass : further) pass = anyPass<D>(random, false);
  const double rate = std::array{0.5, 1.0, 0.1, 0.9}[seed % 4];
  return forgedStream<D>(header, passes, further,
                         [&](auto code) { return randomlyCoded<D>(random(), rate, code); });
}

template <int D>
void expectHarmless(uint64_t seeds) {
  for (const Header& header : headersOf(D)) {
    for (uint64_t seed = 0; seed < seeds; ++seed) {
      SCOPED_TRACE(std::to_string(D) + " dimensions, seed " + std::to_string(seed));
      EXPECT_EQ(harmlesslyDecoded(anyStream<D>(header, seed)).error(), Error::None);
    }
  }
}

TEST(HostileDisplacements, anyPassesShowSoundSurfaces) {
  expectHarmless<2>(24);
  expectHarmless<3>(12);
  expectHarmless<4>(4);
}

/// Each prefix of small streams, some of larger ones.
template <int D>
void expectHarmlessWhereTorn(uint64_t seed, std::size_t prefixes) {
  for (const Header& header : headersOf(D)) {
    const Bytes bytes = anyStream<D>(header, seed);
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / prefixes) {
      SCOPED_TRACE(std::to_string(D) + " dimensions, " + std::to_string(length) + " bytes");
      const Decoder decoder = decoderOf(std::span(bytes).first(length), kTight);
      EXPECT_EQ(decoder.error(), Error::Truncated);
      if (decoder.ready()) showHarmlessly(decoder, {kPolygonizers[length % 2]}, kTight);
    }
  }
}

TEST(HostileDisplacements, areHarmlessWhenTornAnywhere) {
  for (const uint64_t seed : {5, 8}) expectHarmlessWhereTorn<2>(seed, 600);
  expectHarmlessWhereTorn<3>(5, 200);
  expectHarmlessWhereTorn<4>(5, 40);
}

/// A surface of random decisions, then displacements of noise.
Bytes displacedByNoise(double rate, std::size_t length) {
  constexpr int kLayersBefore = 4;
  int layer = 0;
  return forgedStream<3>(
      boxOf(3), {{.kind = LayerKind::Displacement, .displacement = {1, 1}}}, {}, [&](auto code) {
        return layer++ < kLayersBefore ? randomlyCoded<3>(1, rate, code) : noiseOf(length, length);
      });
}

TEST(HostileDisplacements, fieldsOutOfRangeAreCorrupt) {
  const Bytes good = displacedByNoise(0.5, 9000);
  const StreamLayout layout(good);
  for (unsigned field = 0; field < 256; ++field) {
    Bytes bytes = good;
    bytes[layout.layers.back().payload] = static_cast<std::byte>(field);
    EXPECT_EQ(decoderOf(repaired(bytes, layout)).error(),
              (field & 3) == 0 || field >> 2 == 0 ? Error::Corrupt : Error::None)
        << field;
  }
}

TEST(HostileDisplacements, areCorruptInAdaptiveStreams) {
  Header header = boxOf(3);
  header.size = {5, 5, 5, 1};  // the base alone
  header.adaptive = true;
  const Bytes base = randomlyCoded<3>(
      1, 0.5, [&](auto& exchange) { AdaptiveMesh<3>(header.base<3>()).base(exchange); });
  const Bytes bytes = assembled(
      header, {{LayerHead{}, base}, {{.kind = LayerKind::Displacement}, Bytes(20, std::byte{5})}});
  EXPECT_EQ(harmlesslyDecoded(bytes).error(), Error::Corrupt);
}

TEST(HostileDisplacements, areHarmlessWithoutASurface) {
  for (const std::size_t length : {0u, 1u, 100u}) {
    const Decoder decoder = harmlesslyDecoded(displacedByNoise(0, length));
    EXPECT_EQ(decoder.error(), Error::None);
    EXPECT_TRUE(meshOf(decoder).positions.empty());
  }
}

/// The largest displacements in either direction.
struct FarField : NoScalars {
  [[nodiscard]] int displacement(std::size_t brickIndex, std::size_t block) const {
    return (brickIndex + block) % 3 == 0 ? -4 : 4;
  }
};

template <int D>
void expectHarmlessWhereFarthest() {
  const Header header = boxOf(D);
  Layers layers;
  CodecState<D> known(header);
  layers.push_back(
      {LayerHead{}, randomlyCoded<D>(1, 0.5, [&](auto& exchange) { known.base(exchange); })});
  for (int level = 1; level <= header.finestLevel(); ++level) {
    layers.push_back({{.kind = LayerKind::Refinement, .level = level},
                      randomlyCoded<D>(2, 0.5, [&](auto& exchange) { known.refine(exchange); })});
  }
  GeometryPass<D> pass;
  pass.kind = LayerKind::Displacement;
  pass.displacement = {1, 63};
  for (int i = 0; i < 3; ++i) {
    Bytes bytes = fieldsOf<D>(pass);
    const Bytes far =
        coded(known.signs, FarField(), [&](auto& exchange) { known.geometry(exchange, pass); });
    bytes.insert(bytes.end(), far.begin(), far.end());
    layers.push_back({{.kind = LayerKind::Displacement, .level = header.finestLevel()}, bytes});
  }
  EXPECT_EQ(harmlesslyDecoded(assembled(header, layers)).error(), Error::None);
}

TEST(HostileDisplacements, theLargestAreShown) {
  expectHarmlessWhereFarthest<2>();
  expectHarmlessWhereFarthest<3>();
  expectHarmlessWhereFarthest<4>();
}

void expectWithinMemory(const Header& header, double rate,
                        const std::vector<GeometryPass<3>>& passes, std::size_t least,
                        std::size_t most, std::size_t step) {
  uint64_t seed = 5;
  const Bytes bytes = forgedStream<3>(
      header, passes, {}, [&](auto code) { return randomlyCoded<3>(++seed, rate, code); });
  for (std::size_t memory = least; memory <= most; memory += step) {
    Error error;
    EXPECT_LE(peakOf(bytes, {1u << 26, 1u << 26, memory}, error), memory + kModels + bytes.size())
        << memory << (header.keepsTopology ? " bytes, welded" : " bytes");
    EXPECT_TRUE(error == Error::None || error == Error::OverLimit);
  }
}

/// Before and after scalars, for as much surface as possible and for a box without any.
TEST(HostileDisplacements, stayWithinTheMemoryAllowed) {
  constexpr std::size_t kMegabyte = 1u << 20;
  const GeometryPass<3> displacement{.kind = LayerKind::Displacement, .displacement = {1, 20}},
      exponents{};
  Header header = boxOf(3);
  for (const bool welded : {false, true}) {
    header.size = {50, 60, 40, 1};
    header.keepsTopology = welded;
    expectWithinMemory(header, 0.5, {displacement, exponents, displacement}, kMegabyte / 2,
                       3 * kMegabyte, kMegabyte / 2);
  }
  header.size = {2, 2, 1 << 23, 1};
  header.keepsTopology = false;
  expectWithinMemory(header, 0, {exponents, displacement}, 11 * kMegabyte, 17 * kMegabyte,
                     2 * kMegabyte);
}

}  // namespace
}  // namespace isostar
