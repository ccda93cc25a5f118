// Further isovalues (§5.4): each isovalue of a stream has the surface that it would have alone.
#include "round_trip.h"
#include "sampled_image.h"
#include "surface_checks.h"

namespace isostar {
namespace {

MeshOptions at(double isovalue, Polygonizer polygonizer = Polygonizer::Cubes) {
  MeshOptions options{polygonizer, Frame::Grid, true};
  options.isovalue = isovalue;
  return options;
}

EncodeOptions isovalues(double isovalue, std::vector<double> others) {
  EncodeOptions options;
  options.isovalue = isovalue;
  options.furtherIsovalues = std::move(others);
  return options;
}

/// Isovalues in the scale of the field: close together and far apart, on both sides of the first,
/// at samples, and beyond all samples.
std::vector<EncodeOptions> selections(const SampledField& field) {
  const bool whole = field.name == "whole numbers";
  const double unit = whole ? 100 : 1;
  return {isovalues(0, {0.02 * unit}),
          isovalues(0.1 * unit, {-0.05 * unit, 0.3 * unit, 0.2 * unit}),
          isovalues(0, {1e-9, -1e-9, 2e-9}), isovalues(0.5 * unit, {0, unit}),
          isovalues(100 * unit, {0, 200 * unit, -1e30})};
}

/// Each vertex lies within `bound` grid steps of the same vertex of the source's own surface, apart
/// from rounding to single precision.
void expectSourcesSurface(const Decoder& decoder, const SampledField& field, double isovalue,
                          Polygonizer polygonizer, double bound) {
  SCOPED_TRACE("isovalue " + std::to_string(isovalue));
  const Mesh mesh = meshOf(decoder, at(isovalue, polygonizer));
  const Mesh source = sourceMesh(field, {polygonizer, Frame::Grid, true}, isovalue);
  expectSound(mesh);
  ASSERT_EQ(mesh.indices, source.indices);
  ASSERT_EQ(mesh.positions.size(), source.positions.size());
  EXPECT_LE(furthest(mesh, source, field.placement),
            bound + 2e-5 + 2e-6 * std::max({field.size[0], field.size[1], field.size[2]}));
}

void expectAllSurfaces(const SampledField& field, EncodeOptions options) {
  for (const Polygonizer polygonizer : kPolygonizers) {
    for (const bool lossless : {true, false}) {
      SCOPED_TRACE(described(field) + ", " + named(polygonizer) + (lossless ? ", lossless" : ""));
      options.polygonizer = polygonizer;
      options.lossless = lossless;
      const Decoder decoder = decoderOf(encoded(field, options));
      ASSERT_TRUE(decoder.isFinal());
      ASSERT_EQ(decoder.info().isovalues.size(), options.furtherIsovalues.size() + 1);
      for (const double isovalue : decoder.info().isovalues)
        expectSourcesSurface(decoder, field, isovalue, polygonizer,
                             lossless ? 0 : options.maxError);
    }
  }
}

TEST(FurtherIsovaluesRoundTrip, eachIsovalueHasItsOwnSurface) {
  for (const Size& size :
       {Size{2, 2, 2}, Size{5, 7, 3}, Size{9, 9, 9}, Size{17, 16, 33}, Size{2, 40, 2}}) {
    for (const auto& field : fieldsOf(size)) {
      for (const auto& options : selections(field)) expectAllSurfaces(field, options);
    }
  }
}

TEST(FurtherIsovaluesRoundTrip, holdForBytesAsFractions) {
  auto field = sampled("bytes", {17, 12, 20}, [](double x, double y, double z) {
    return std::round(127 + 60 * gyroid(9)(x, y, z)) / 255;
  });
  expectAllSurfaces(field, isovalues(0.5, {0.2, 52.0 / 255, 0.51, 0.6}));
}

TEST(FurtherIsovaluesRoundTrip, showNewComponents) {
  const Field rough = noise(11);
  for (const double share : {0.02, 0.3}) {
    const auto field = sampled("crumbs", {30, 30, 30}, [&](double x, double y, double z) {
      const double r = rough(x, y, z);
      return r > 1 - share ? 10 + r : r < share - 1 ? -10 + r : x - 12.3;
    });
    expectAllSurfaces(field, isovalues(0.2, {-9, 8.9, 10.5}));
  }
}

TEST(FurtherIsovaluesRoundTrip, theFirstSurfaceTakesAsManyBytesAsAlone) {
  for (const auto& field : {sampled("whole", {33, 30, 31}, [](double x, double y, double z) {
         return std::round(100 * gyroid(13)(x, y, z));
       })}) {
    const Bytes alone = encoded(field, isovalues(10.5, {})),
                both = encoded(field, isovalues(10.5, {12.5}));
    StreamInfo one, two;
    ASSERT_EQ(inspect(alone, one), Error::None);
    ASSERT_EQ(inspect(both, two), Error::None);
    ASSERT_GT(two.layers.size(), one.layers.size());
    for (std::size_t i = 0; i < two.layers.size(); ++i)
      EXPECT_EQ(two.layers[i].isovalue, i < one.layers.size() ? 0 : 1);
    // The last layers differ: RDOQ is used in streams of one isovalue only.
    const auto similar = [](uint64_t bytes, uint64_t others) {
      return bytes < others * 102 / 100 && others < bytes * 102 / 100;
    };
    EXPECT_TRUE(similar(two.layers[one.layers.size() - 1].offset, alone.size()));
    // A further isovalue takes far less: it lies two quantization steps away, of a hundred per grid
    // step.
    EXPECT_LT(both.size() - alone.size(), alone.size() / 4);
  }
}

/// Without RDOQ: lossless streams, and loose bounds.
TEST(FurtherIsovaluesRoundTrip, theFirstSurfaceHasTheSameBytesAsAloneWithoutRdoq) {
  const auto field = sampled("whole", {33, 30, 31}, [](double x, double y, double z) {
    return std::round(100 * gyroid(13)(x, y, z));
  });
  for (const bool lossless : {false, true}) {
    EncodeOptions single = isovalues(10.5, {}), several = isovalues(10.5, {12.5});
    single.lossless = several.lossless = lossless;
    single.maxError = several.maxError = 0.2;
    const Bytes alone = encoded(field, single), both = encoded(field, several);
    ASSERT_GT(both.size(), alone.size());
    EXPECT_TRUE(std::equal(
        alone.begin() + static_cast<std::ptrdiff_t>(infoOf(alone).layers[0].offset), alone.end(),
        both.begin() + static_cast<std::ptrdiff_t>(infoOf(both).layers[0].offset)));
  }
}

TEST(FurtherIsovaluesRoundTrip, theNearestIsCodedFirst) {
  const auto field = sampled("sphere", {12, 12, 12}, sphere({12, 12, 12}));
  StreamInfo info;
  ASSERT_EQ(inspect(encoded(field, isovalues(0, {3, -1, 1.5, -2})), info), Error::None);
  EXPECT_EQ(info.isovalues, (std::vector<double>{0, -1, -2, 1.5, 3}));
}

TEST(FurtherIsovaluesRoundTrip, everyPrefixShowsEveryIsovalue) {
  const Size size{9, 8, 10};
  for (const auto& field : fieldsOf(size)) {
    const Bytes bytes = encoded(field, isovalues(0, {0.1, -0.1}));
    for (std::size_t length = 0; length < bytes.size(); length += 3) {
      const Decoder decoder = decoderOf(std::span(bytes).first(length));
      ASSERT_EQ(decoder.error(), Error::Truncated);
      if (!decoder.ready()) continue;
      for (const double isovalue : {-0.1, -0.03, 0.0, 0.05, 0.1}) {
        const Mesh mesh = meshOf(decoder, at(isovalue));
        expectSound(mesh);
        expectClosed(mesh, size);
      }
    }
  }
}

TEST(FurtherIsovaluesRoundTrip, surfacesInBetweenMoveFromOneToTheOther) {
  const Size size{30, 30, 30};
  const auto field = sampled("sphere", size, sphere(size));
  const Decoder decoder = decoderOf(encoded(field, isovalues(0, {2})));
  for (const double isovalue : {0.0, 0.25, 0.5, 1.0, 1.5, 1.75, 2.0}) {
    const double radius = 0.35 * 29 + 0.013 - isovalue;
    const Mesh mesh = meshOf(decoder, at(isovalue));
    double sum = 0;
    for (uint32_t i = 0; i < verticesOf(mesh); ++i) {
      Point p = pointAt(mesh.positions, i);
      for (double& c : p) c -= 14.5;
      sum += std::pow(std::sqrt(dot(p, p)) - radius, 2);
    }
    EXPECT_LT(std::sqrt(sum / verticesOf(mesh)), 0.3) << isovalue;
    expectClosed(mesh, size);
  }
}

TEST(FurtherIsovaluesRoundTrip, surfacesInBetweenAreExactWhereAllScalarsAreKnown) {
  const auto field = sampled("whole", {20, 20, 20}, [](double x, double y, double z) {
    return std::round(200 * gyroid(13)(x, y, z));
  });
  EncodeOptions options = isovalues(0.5, {4.5});
  options.lossless = true;
  const Decoder decoder = decoderOf(encoded(field, options));
  for (const double isovalue : {1.0, 1.5, 2.75, 4.25})
    expectSourcesSurface(decoder, field, isovalue, Polygonizer::Cubes, 0);
}

TEST(FurtherIsovaluesRoundTrip, isovaluesOutsideTheStreamAreBadArguments) {
  const auto field = sampled("sphere", {9, 9, 9}, sphere({9, 9, 9}));
  const Decoder decoder = decoderOf(encoded(field, isovalues(0, {0.5, -0.25})));
  Mesh mesh;
  for (const double isovalue : {-0.3, 0.6, double(NAN), double(INFINITY)})
    EXPECT_EQ(decoder.mesh(at(isovalue), mesh), Error::BadArgument) << isovalue;
  Bytes bytes;
  for (const auto& others :
       std::vector<std::vector<double>>{{0}, {1, 1}, {NAN}, {INFINITY}, std::vector<double>(16, 1)})
    EXPECT_EQ(encode(field.volume(), isovalues(0, others), bytes), Error::BadArgument);
  EXPECT_TRUE(bytes.empty());
}

TEST(FurtherIsovaluesRoundTrip, holdForImages) {
  for (const ImageSize& size : kImageSizes) {
    for (const SampledImage& image : imagesOf(size)) {
      SCOPED_TRACE(drawn(image));
      EncodeOptions options = isovalues(0.5, {0.55, 0.3});
      options.lossless = true;
      Bytes bytes;
      ASSERT_EQ(encode(image.image(), options, bytes), Error::None);
      const Decoder decoder = decoderOf(bytes);
      for (const double isovalue : {0.5, 0.55, 0.3}) {
        Contours source;
        ASSERT_EQ(polygonize(image.image(), isovalue, at(isovalue), source), Error::None);
        const Contours found = contoursOf(decoder, at(isovalue));
        ASSERT_EQ(found.starts, source.starts);
        for (std::size_t i = 0; i < found.points.size(); ++i)
          ASSERT_NEAR(found.points[i], source.points[i], 1e-4);
      }
    }
  }
}

}  // namespace
}  // namespace isostar
