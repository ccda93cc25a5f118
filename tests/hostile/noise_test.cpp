// Streams whose layers are noise or random decisions, with correct checksums: decoding ends, within
// the limits.

#include "allocation.h"
#include "forged_streams.h"
#include "harmless.h"

namespace isostar {
namespace {

Header headerOf(const Size& size) {
  Header header;
  header.size = {size[0], size[1], size[2], 1};
  header.countWhole(1);
  return header;
}

GeometryPass<3> wideOpen(LayerKind kind, Members members) {
  return {kind, members, 2, {1, 1, 1, 1, 1, 1, 1, 1}, 30, false};
}

/// The base, all refinement levels, some geometry of each kind.
template <class Payload>
Bytes streamOf(const Header& header, Payload payload) {
  std::vector<GeometryPass<3>> passes, further;
  for (const LayerKind kind : {LayerKind::Displacement, LayerKind::Exponents, LayerKind::Magnitudes,
                               LayerKind::Magnitudes}) {
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds})
      passes.push_back(wideOpen(kind, members));
  }
  for (const LayerKind kind : {LayerKind::Exponents, LayerKind::Magnitudes})
    further.push_back(wideOpen(kind, Members::AxisEnds));
  return forgedStream<3>(header, passes, further, payload);
}

Header weldedOf(const Size& size) {
  Header header = headerOf(size);
  header.keepsTopology = true;
  return header;
}

/// Scalars are predicted by local fits.
Header fittedOf(const Size& size) {
  Header header = headerOf(size);
  header.fitted = true;
  return header;
}

Header severalOf(const Size& size, bool whole = true) {
  Header header = headerOf(size);
  header.whole = whole;
  header.furtherIsovalues = {3, -100, 1e9, -1e300, 0};
  return header;
}

Bytes noiseStream(const Header& header, std::size_t length, uint64_t seed) {
  return streamOf(header, [&](auto) { return noiseOf(length, ++seed); });
}
Bytes randomStream(const Header& header, uint64_t seed, double rate) {
  return streamOf(header, [&](auto code) { return randomlyCoded<3>(++seed, rate, code); });
}

const std::vector<Size> kHostileSizes{{9, 9, 9},       {100, 100, 100}, {1, 1 << 11, 1 << 11},
                                      {1 << 22, 1, 1}, {2, 2, 1 << 20}, {160, 160, 160}};

TEST(HostileNoise, isHarmlessAtEachSizeAndLength) {
  for (const Size& size : kHostileSizes) {
    for (std::size_t length : {0u, 1u, 3u, 20u, 1000u}) {
      SCOPED_TRACE(testing::PrintToString(size) + ", layers of " + std::to_string(length) +
                   " bytes");
      (void)harmlesslyDecoded(noiseStream(headerOf(size), length, length));
    }
  }
}

TEST(HostileNoise, decodingEndsWithTheBudgetOfDecisions) {
  const auto field = sampled("gyroid", {40, 40, 40}, gyroid());
  const Bytes bytes = encoded(field);
  Limits limits;
  limits.decisions = 20'000;
  const Decoder decoder = decoderOf(bytes, limits);
  EXPECT_EQ(decoder.error(), Error::OverLimit);
  EXPECT_FALSE(decoder.isFinal());
  limits.decisions = 2'000'000;
  EXPECT_EQ(decoderOf(bytes, limits).error(), Error::None);
}

TEST(HostileNoise, randomDecisionsGiveClosedSurfaces) {
  for (const Size& size : {Size{9, 9, 9}, Size{17, 12, 30}}) {
    for (uint64_t seed = 0; seed < 12; ++seed) {
      const double rate = std::array{0.5, 0.03, 0.97, 1.0}[seed % 4];
      SCOPED_TRACE(testing::PrintToString(size) + ", seed " + std::to_string(seed));
      const Bytes bytes = randomStream(headerOf(size), seed, rate);
      const Decoder decoder = harmlesslyDecoded(bytes);
      EXPECT_EQ(decoder.error(), Error::None);
      for (const Polygonizer polygonizer : kPolygonizers)
        expectClosed(meshOf(decoder, {polygonizer, Frame::Grid, true}), size);
    }
  }
}

TEST(HostileNoise, furtherIsovaluesEndSoonAndAreClosed) {
  for (const Size& size : {Size{9, 9, 9}, Size{17, 12, 30}}) {
    for (uint64_t seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(testing::PrintToString(size) + ", seed " + std::to_string(seed));
      const Header header = severalOf(size, seed % 2 == 0);
      const Decoder decoder =
          harmlesslyDecoded(randomStream(header, seed, std::array{0.5, 1.0, 0.03, 0.97}[seed / 2]));
      EXPECT_EQ(decoder.error(), Error::None);
      for (const double isovalue : isovaluesToShow(decoder.info())) {
        MeshOptions options{Polygonizer::Cubes, Frame::Grid, true};
        options.isovalue = isovalue;
        expectClosed(meshOf(decoder, options), size);
      }
    }
  }
  for (const Size& size : kHostileSizes) {
    for (std::size_t length : {0u, 20u, 1000u})
      (void)harmlesslyDecoded(noiseStream(severalOf(size), length, length));
  }
}

/// The same for an adaptive mesh.
template <class Payload>
Bytes adaptiveStreamOf(Header header, Payload payload) {
  header.adaptive = true;
  Layers layers;
  AdaptiveField<3> field(header.base<3>());
  for (int level = 0; level <= header.finestLevel(); ++level) {
    const LayerKind kind = level == 0 ? LayerKind::Base : LayerKind::Refinement;
    layers.push_back({{kind, level, 0.1, 0, 0}, payload([&](auto& exchange) {
                        level == 0 ? field.mesh.base(exchange) : field.mesh.refine(exchange);
                      })});
  }
  for (int level = 0; level <= header.finestLevel(); ++level) {
    for (const LayerKind kind : {LayerKind::Exponents, LayerKind::Magnitudes}) {
      const GeometryPass<3> pass = wideOpen(kind, Members::AxisEnds);
      Bytes bytes = fieldsOf<3>(pass);
      const Bytes coded = payload([&](auto& exchange) {
        if (kind == LayerKind::Exponents)
          field.codeExponents(exchange, pass.exponentRange, header.polygonizer);
        else
          field.codeMagnitudes(exchange, pass.magnitudePass(header.fitted));
      });
      bytes.insert(bytes.end(), coded.begin(), coded.end());
      layers.push_back({{kind, level, 0.1, 0, 0}, bytes});
    }
  }
  return assembled(header, layers);
}

TEST(HostileNoise, meshesOfAnyCellsEndSoonAndAreClosed) {
  for (const Size& size : {Size{9, 9, 9}, Size{17, 12, 30}}) {
    for (uint64_t seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(testing::PrintToString(size) + ", seed " + std::to_string(seed));
      const double rate = std::array{0.5, 1.0, 0.03, 0.97}[seed / 2];
      const auto randomly = [&](auto code) { return randomlyCoded<3>(++seed * 100, rate, code); };
      for (const Bytes& bytes :
           {randomStream(weldedOf(size), seed, rate), randomStream(fittedOf(size), seed, rate),
            adaptiveStreamOf(fittedOf(size), randomly)}) {
        const Decoder decoder = harmlesslyDecoded(bytes);
        EXPECT_EQ(decoder.error(), Error::None);
        for (const Polygonizer polygonizer : kPolygonizers)
          expectClosed(meshOf(decoder, {polygonizer, Frame::Grid, true}), size);
      }
    }
  }
  for (const Size& size : kHostileSizes) {
    for (std::size_t length : {0u, 20u, 1000u}) {
      uint64_t seed = length;
      (void)harmlesslyDecoded(noiseStream(weldedOf(size), length, seed));
      (void)harmlesslyDecoded(noiseStream(fittedOf(size), length, seed));
      (void)harmlesslyDecoded(
          adaptiveStreamOf(headerOf(size), [&](auto) { return noiseOf(length, ++seed); }));
    }
  }
}

/// Values as large as they can be.
struct SteepField {
  [[nodiscard]] uint32_t magnitude(std::size_t, std::size_t, int) const { return (1u << 29) - 1; }
  [[nodiscard]] int gradient(std::size_t) const { return 4 * 31 + 3; }
  [[nodiscard]] int displacement(std::size_t, std::size_t) const { return 4; }
  [[nodiscard]] bool selected(std::size_t) const { return true; }
};

TEST(HostileNoise, theSteepestFieldIsShownAtEachPrefix) {
  const Header header = headerOf({9, 9, 9});
  Layers layers;
  CodecState<3> known(header);
  layers.push_back(
      {LayerHead{}, randomlyCoded<3>(1, 0.5, [&](auto& exchange) { known.base(exchange); })});
  for (int level = 1; level <= header.finestLevel(); ++level) {
    layers.push_back({{.kind = LayerKind::Refinement, .level = level},
                      randomlyCoded<3>(2, 0.5, [&](auto& exchange) { known.refine(exchange); })});
  }
  const GeometryPass<3> pass{.kind = LayerKind::Exponents, .exponentRange = 0};
  Bytes geometry = fieldsOf<3>(pass);
  const Bytes steep =
      coded(known.signs, SteepField(), [&](auto& exchange) { known.geometry(exchange, pass); });
  geometry.insert(geometry.end(), steep.begin(), steep.end());
  layers.push_back({{.kind = LayerKind::Exponents, .level = header.finestLevel()}, geometry});
  const Bytes bytes = assembled(header, layers);
  EXPECT_EQ(harmlesslyDecoded(bytes).error(), Error::None);
  for (std::size_t length = bytes.size() - geometry.size(); length < bytes.size(); ++length)
    (void)harmlesslyDecoded(std::span(bytes).first(length));
}

TEST(HostileNoise, staysWithinTheMemoryAllowed) {
  for (const Size& size : {Size{100, 100, 100}, Size{1 << 19, 1, 1}, Size{2, 2, 1 << 17}}) {
    for (const double rate : {0.5, 1.0}) {
      for (const Header& header : {headerOf(size), weldedOf(size)}) {
        const Bytes bytes = randomStream(header, 5, rate);
        for (const std::size_t megabytes : {1u, 4u}) {
          Error error;
          const std::size_t peak = peakOf(bytes, {1u << 22, 1u << 26, megabytes << 20}, error);
          EXPECT_LE(peak, (megabytes << 20) + kModels + bytes.size())
              << testing::PrintToString(size) << ", " << megabytes << " MB, rate " << rate
              << (header.keepsTopology ? ", welded" : "");
          EXPECT_TRUE(error == Error::None || error == Error::OverLimit);
        }
      }
    }
  }
}

TEST(HostileNoise, furtherIsovaluesStayWithinTheMemoryAllowed) {
  for (const Size& size : {Size{100, 100, 100}, Size{2, 2, 1 << 15}}) {
    const Bytes bytes = randomStream(severalOf(size), 5, 1.0);
    for (const std::size_t megabytes : {1u, 4u, 16u}) {
      Error error;
      const std::size_t peak = peakOf(bytes, {1u << 22, 1u << 26, megabytes << 20}, error);
      EXPECT_LE(peak, (megabytes << 20) + kModels + bytes.size())
          << testing::PrintToString(size) << ", " << megabytes << " MB";
      EXPECT_TRUE(error == Error::None || error == Error::OverLimit);
    }
  }
}

TEST(HostileNoise, emptyLevelsOfHugeBoxesAreOverLimit) {
  // All decisions are false: no surface, but a table of bricks for each level of a huge box.
  for (const Size& size :
       {Size{1 << 11, 1 << 10, 1 << 10}, Size{(1 << 28) - 1, 2, 2}, Size{1 << 15, 1 << 15, 1}}) {
    for (const Header& header : {headerOf(size), weldedOf(size)}) {
      Layers layers;
      for (int level = 0; level <= header.finestLevel(); ++level) {
        layers.push_back(
            {{.kind = level == 0 ? LayerKind::Base : LayerKind::Refinement, .level = level},
             Bytes(20, std::byte{0xFF})});
      }
      Error error;
      EXPECT_LE(peakOf(assembled(header, layers), {1u << 31, 1u << 26, 1u << 20}, error),
                (1u << 20) + kModels)
          << testing::PrintToString(size);
      EXPECT_EQ(error, Error::OverLimit) << testing::PrintToString(size);
    }
  }
}

}  // namespace
}  // namespace isostar
