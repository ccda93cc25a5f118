// More effort makes smaller streams that keep the same bounds.
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

EncodeOptions withEffort(int effort, double maxError = 0.05) {
  EncodeOptions options;
  options.effort = effort;
  options.maxError = maxError;
  return options;
}

TEST(Effort, keepsTheBound) {
  for (const auto& field : fieldsOf({17, 16, 33})) {
    for (const double maxError : {0.3, 0.05, 0.01, 1e-7}) {
      for (const Polygonizer polygonizer : kPolygonizers) {
        SCOPED_TRACE(described(field) + ", " + named(polygonizer) + ", " +
                     std::to_string(maxError));
        EncodeOptions options = withEffort(2, maxError);
        options.polygonizer = polygonizer;
        const MeshOptions grid{polygonizer, Frame::Grid, true};
        const Mesh source = sourceMesh(field, grid), mesh = decoded(encoded(field, options), grid);
        expectSound(mesh);
        ASSERT_EQ(mesh.indices, source.indices);
        EXPECT_LE(furthest(mesh, source, field.placement), maxError + 2e-5);
      }
    }
  }
}

TEST(Effort, isLosslessOnRequest) {
  for (const auto& field : fieldsOf({12, 15, 14})) {
    EncodeOptions options = withEffort(2);
    options.lossless = true;
    const Mesh source = sourceMesh(field), mesh = decoded(encoded(field, options));
    EXPECT_EQ(mesh.positions, source.positions) << described(field);
    EXPECT_EQ(mesh.indices, source.indices) << described(field);
  }
}

TEST(Effort, combinesWithAllOtherOptions) {
  const SampledField field = sampled("ball", {40, 33, 36}, sphere({40, 33, 36}, 0.4));
  EncodeOptions adaptive = withEffort(2, 0.4), topology = withEffort(2), several = withEffort(2);
  adaptive.adaptive = true;
  topology.preserveTopology = true;
  several.furtherIsovalues = {0.5, -0.5};
  for (const EncodeOptions& options : {adaptive, topology, several}) {
    const Bytes bytes = encoded(field, options);
    EXPECT_EQ(infoOf(bytes).effort, 2);
    for (std::size_t length = bytes.size() / 3; length <= bytes.size(); length += 97)
      expectSound(meshOf(decoderOf(std::span(bytes).first(length))));
    expectSound(decoded(bytes));
  }
}

TEST(Effort, makesSmoothSurfacesSmaller) {
  const Size size{64, 64, 64};
  const SampledField field = sampled("gyroid", size, gyroid(24));
  const Bytes one = encoded(field, withEffort(1)), two = encoded(field, withEffort(2));
  EXPECT_EQ(infoOf(one).effort, 1);
  EXPECT_LT(two.size(), one.size() * 9 / 10);
}

TEST(Effort, codesImagesAndSequences) {
  const SampledField field = sampled("frames", {12, 10, 44}, gyroid(9));
  Bytes image, sequence;
  ASSERT_EQ(encode(Image{std::span(field.samples).first(120), {12, 10}, {}}, withEffort(2), image),
            Error::None);
  EXPECT_TRUE(decoderOf(image).isFinal());
  ASSERT_EQ(encode(Sequence{field.samples, {12, 10, 11}, 4, {}}, withEffort(2), sequence),
            Error::None);
  EXPECT_TRUE(decoderOf(sequence).isFinal());
}

TEST(Effort, isOneOrTwo) {
  const SampledField field = sampled("ball", {9, 9, 9}, sphere({9, 9, 9}));
  for (const int effort : {-1, 0, 3}) {
    Bytes bytes;
    EXPECT_EQ(encode(field.volume(), withEffort(effort), bytes), Error::BadArgument);
    EXPECT_TRUE(bytes.empty());
  }
}

}  // namespace
}  // namespace isostar
