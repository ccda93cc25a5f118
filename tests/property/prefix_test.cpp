// Every prefix of a stream decodes to the best surface that its bytes determine.
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

double distanceToSphere(const Mesh& mesh, const Size& size, double radius) {
  double sum = 0;
  for (uint32_t i = 0; i < verticesOf(mesh); ++i) {
    Point p = pointAt(mesh.positions, i);
    for (std::size_t a = 0; a < 3; ++a) p[a] -= 0.5 * (size[a] - 1);
    const double off = std::sqrt(dot(p, p)) - radius;
    sum += off * off;
  }
  return verticesOf(mesh) == 0 ? 0 : std::sqrt(sum / verticesOf(mesh));
}

void expectEachPrefixShows(const SampledField& field, const EncodeOptions& options) {
  const Bytes bytes = encoded(field, options);
  SCOPED_TRACE(described(field) + ", " + std::to_string(bytes.size()) + " bytes");
  uint64_t before = 0;
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    SCOPED_TRACE("the first " + std::to_string(length));
    const Decoder decoder = decoderOf(std::span(bytes).first(length));
    ASSERT_EQ(decoder.error(), length < bytes.size() ? Error::Truncated : Error::None);
    ASSERT_EQ(decoder.isFinal(), length == bytes.size());
    ASSERT_GE(decoder.bytes(), before);
    ASSERT_LE(decoder.bytes(), length);
    before = decoder.bytes();
    Mesh mesh;
    ASSERT_EQ(decoder.mesh({options.polygonizer, Frame::Grid, true}, mesh),
              decoder.ready() ? Error::None : Error::Truncated);
    expectSound(mesh);
    expectClosed(mesh, field.size);
  }
}

TEST(Prefix, ofAnyLengthShowsASoundSurface) {
  for (const Size& size : {Size{2, 2, 2}, Size{5, 4, 6}, Size{9, 9, 9}}) {
    for (const auto& field : fieldsOf(size)) {
      EncodeOptions options;
      expectEachPrefixShows(field, options);
      options.lossless = true;
      options.polygonizer = Polygonizer::Tetrahedra;
      if (field.samples.size() < 200) expectEachPrefixShows(field, options);
    }
  }
}

TEST(Prefix, errorFallsLayerByLayer) {
  const Size size{40, 40, 40};
  for (const auto& field :
       {sampled("sphere", size, sphere(size)), sampled("torus", size, torus(size)),
        sampled("gyroid", size, gyroid(23))}) {
    const Decoder decoder = decoderOf(encoded(field));
    double before = 1e9;
    for (const LayerInfo& layer : decoder.info().layers) {
      EXPECT_LE(layer.error, before * 1.01)
          << field.name << ", " << layer.kind << " " << layer.level;
      before = layer.error;
    }
    EXPECT_LT(before, 0.05) << field.name;
    EXPECT_EQ(decoder.rmsError(), before);
  }
}

TEST(Prefix, errorFallsWithinALevel) {
  const Size size{90, 90, 90};
  const auto field = sampled("sphere", size, sphere(size));
  const Bytes bytes = encoded(field);
  const auto layers = decoderOf(bytes).info().layers;
  const auto errorAt = [&](std::size_t length) {
    const Decoder decoder = decoderOf(std::span(bytes).first(length));
    EXPECT_EQ(decoder.bytes(), length);
    return distanceToSphere(meshOf(decoder, {Polygonizer::Cubes, Frame::Grid, false}), size,
                            0.35 * 89 + 0.013);
  };
  for (std::size_t i = 1; i < layers.size(); ++i) {
    if (layers[i].kind != "refinement" || layers[i].bytes < 300) continue;
    SCOPED_TRACE("level " + std::to_string(layers[i].level));
    double before = errorAt(layers[i - 1].offset);
    for (const std::size_t sixth : {4, 5, 6}) {
      const double error =
          errorAt(layers[i].offset - layers[i].bytes + layers[i].bytes * sixth / 6);
      EXPECT_LT(error, before);
      before = error;
    }
  }
}

TEST(Prefix, theStatedErrorIsTheMeasuredOne) {
  const Size size{60, 60, 60};
  const auto field = sampled("sphere", size, sphere(size));
  Decoder decoder;
  decoder.accept(encoded(field));
  while (decoder.advance()) {
    const double found = distanceToSphere(meshOf(decoder, {Polygonizer::Cubes, Frame::Grid, false}),
                                          size, 0.35 * 59 + 0.013);
    EXPECT_GT(decoder.rmsError(), 0.7 * found - 0.003) << "level " << decoder.level();
    // Between the few vertices of the base the sphere is further away than at them.
    if (decoder.level() > 0) {
      EXPECT_LT(decoder.rmsError(), 1.4 * found + 0.003) << "level " << decoder.level();
    }
  }
}

TEST(Prefix, missingComponentsCountAsError) {
  // The second ball lies between the planes of all levels of step 4 and more.
  const Size size{65, 33, 33};
  const auto field = sampled("two balls", size, [](double x, double y, double z) {
    return std::max(7 - std::hypot(x - 16, y - 16, z - 16),
                    3.4 - std::hypot(x - 54, y - 14, z - 14));
  });
  const StreamInfo info = decoderOf(encoded(field)).info();
  for (const LayerInfo& layer : info.layers) {
    if (layer.level <= info.layers.back().level - 2) {
      EXPECT_GT(layer.error, 8) << "level " << layer.level;
    } else {
      EXPECT_LT(layer.error, 1) << "level " << layer.level;
    }
  }
}

TEST(Prefix, aTornLayerIsNoWorseThanNone) {
  const Size size{30, 30, 30};
  const Bytes bytes = encoded(sampled("sphere", size, sphere(size)));
  const StreamInfo info = decoderOf(bytes).info();
  for (std::size_t length = 100; length < bytes.size(); length += 7) {
    const Decoder decoder = decoderOf(std::span(bytes).first(length));
    if (decoder.level() < decoder.levels() - 1) continue;
    const double found = distanceToSphere(meshOf(decoder, {Polygonizer::Cubes, Frame::Grid, false}),
                                          size, 0.35 * 29 + 0.013);
    EXPECT_LE(found, decoder.rmsError() * 1.25 + 0.002) << length << " bytes";
  }
}

TEST(Prefix, theLevelBeforeTheFinestIsDisplaced) {
  // The plane lies a step off the place where the signs of that level put it.
  const Size size{49, 49, 49};
  const Bytes bytes = encoded(sampled(
      "plane", size, [](double x, double y, double z) { return z - 21.9 - 0.02 * x + 0.01 * y; }));
  const StreamInfo info = decoderOf(bytes).info();
  const auto off = [&](const LayerInfo& layer) {
    const Mesh mesh = meshOf(decoderOf(std::span(bytes).first(layer.offset)),
                             {Polygonizer::Cubes, Frame::Grid, false});
    double sum = 0;
    for (uint32_t i = 0; i < verticesOf(mesh); ++i) {
      const Point p = pointAt(mesh.positions, i);
      const double distance = p[2] - 21.9 - 0.02 * p[0] + 0.01 * p[1];
      sum += distance * distance;
    }
    return std::sqrt(sum / verticesOf(mesh));
  };
  const auto displaced =
      std::find_if(info.layers.begin(), info.layers.end(),
                   [](const LayerInfo& layer) { return layer.kind == "geometry"; });
  ASSERT_NE(displaced, info.layers.end());
  EXPECT_EQ(displaced->level, info.layers.back().level - 1);
  EXPECT_LT(off(*displaced), 0.6 * off(displaced[-1]));
  EXPECT_LT(displaced->error, displaced[-1].error);
}

TEST(Prefix, layersStateWhereTheyEnd) {
  const Bytes bytes = encoded(sampled("gyroid", {30, 20, 25}, gyroid()));
  const StreamInfo whole = decoderOf(bytes).info();
  ASSERT_FALSE(whole.layers.empty());
  EXPECT_EQ(whole.bytes, bytes.size());
  uint64_t sum = whole.headerBytes;
  for (std::size_t i = 0; i < whole.layers.size(); ++i) {
    const auto& layer = whole.layers[i];
    sum += layer.bytes;
    EXPECT_EQ(decoderOf(std::span(bytes).first(layer.offset)).info().layers.size(), i + 1);
    EXPECT_EQ(decoderOf(std::span(bytes).first(layer.offset - 1)).info().layers.size(), i);
  }
  EXPECT_EQ(sum, bytes.size());
  EXPECT_EQ(whole.layers.back().offset, bytes.size());
}

TEST(Prefix, inspectAgreesWithTheDecoder) {
  const auto field = sampled("gyroid", {30, 20, 25}, gyroid());
  const Bytes bytes = encoded(field);
  StreamInfo found;
  ASSERT_EQ(inspect(bytes, found), Error::None);
  const StreamInfo expected = decoderOf(bytes).info();
  ASSERT_EQ(found.layers.size(), expected.layers.size());
  for (std::size_t i = 0; i < found.layers.size(); ++i) {
    EXPECT_EQ(found.layers[i].kind, expected.layers[i].kind);
    EXPECT_EQ(found.layers[i].offset, expected.layers[i].offset);
    EXPECT_EQ(found.layers[i].error, expected.layers[i].error);
  }
  EXPECT_EQ(found.bytes, bytes.size());
  EXPECT_EQ(found.vertices, verticesOf(sourceMesh(field)));
  EXPECT_EQ(found.size, field.size);
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    StreamInfo part;
    const Error error = inspect(std::span(bytes).first(length), part);
    ASSERT_TRUE(error == Error::None || (error == Error::Truncated && length < 64)) << length;
  }
}

}  // namespace
}  // namespace isostar
