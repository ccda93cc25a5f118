// What encode() accepts and refuses, and what it does not touch.
#include <limits>

#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                kInfinity = std::numeric_limits<float>::infinity();

SampledField small() {
  return sampled("gyroid", {6, 5, 4}, gyroid());
}

void expectRefused(const SampledField& field, const EncodeOptions& options = {}) {
  const Bytes before{std::byte{1}, std::byte{2}};
  Bytes out = before;
  EXPECT_EQ(encode(field.volume(), options, out), Error::BadArgument);
  EXPECT_EQ(out, before);
}

void expectNotPolygonized(const SampledField& field, double isovalue = 0) {
  Mesh mesh;
  EXPECT_EQ(polygonize(field.volume(), isovalue, {}, mesh), Error::BadArgument);
}

TEST(Encoding, refusesInvalidSizes) {
  for (const Size& size :
       {Size{0, 5, 4}, Size{6, -5, 4}, Size{-6, -5, 4}, Size{6, 5, 5}, Size{6, 5, 3},
        Size{INT32_MAX, INT32_MAX, INT32_MAX}, Size{INT32_MIN, 5, 4},
        Size{1 << 16, 1 << 16, 1 << 16}, Size{1 << 30, 1, 1}}) {
    SCOPED_TRACE(testing::PrintToString(size));
    SampledField field = small();
    field.size = size;
    expectRefused(field);
    expectNotPolygonized(field);
  }
  SampledField nothing{"nothing", {0, 0, 0}, {}};
  expectRefused(nothing);
}

TEST(Encoding, refusesSamplesThatAreNotFinite) {
  for (float bad : {kNan, kInfinity, -kInfinity}) {
    for (std::size_t at : {std::size_t{0}, std::size_t{57}, std::size_t{119}}) {
      SampledField field = small();
      field.samples[at] = bad;
      expectRefused(field);
      expectNotPolygonized(field);
    }
  }
}

TEST(Encoding, refusesInvalidOptions) {
  for (double bad : {double{kNan}, double{kInfinity}, -double{kInfinity}}) {
    EncodeOptions options;
    options.isovalue = bad;
    expectRefused(small(), options);
    expectNotPolygonized(small(), bad);
    options = {};
    options.maxError = bad;
    expectRefused(small(), options);
  }
  for (double bad : {0.0, -1.0}) {
    EncodeOptions options;
    options.maxError = bad;
    expectRefused(small(), options);
  }
}

TEST(Encoding, refusesSingularPlacements) {
  std::vector<Placement> bad(8);
  bad[0].spacing[1] = 0;
  bad[1].spacing[2] = -1;
  bad[2].spacing[0] = kNan;
  bad[3].spacing[0] = kInfinity;
  bad[4].origin[2] = kNan;
  bad[5].direction[4] = kInfinity;
  bad[6].direction = {};
  bad[7].direction = {1, 0, 0, 1, 0, 0, 0, 0, 1};
  for (std::size_t i = 0; i < bad.size(); ++i) {
    SCOPED_TRACE(i);
    SampledField field = small();
    field.placement = bad[i];
    expectRefused(field);
    expectNotPolygonized(field);
  }
}

TEST(Encoding, losslessNeedsNoBound) {
  EncodeOptions options;
  options.lossless = true;
  options.maxError = kNan;
  EXPECT_FALSE(encoded(small(), options).empty());
}

TEST(Encoding, appendsToItsOutput) {
  const Bytes alone = encoded(small());
  Bytes out{std::byte{9}};
  ASSERT_EQ(encode(small().volume(), {}, out), Error::None);
  EXPECT_EQ(out[0], std::byte{9});
  EXPECT_EQ(Bytes(out.begin() + 1, out.end()), alone);
}

TEST(Encoding, isDeterministic) {
  for (const auto& field : fieldsOf({20, 13, 17}))
    EXPECT_EQ(encoded(field), encoded(field)) << field.name;
}

TEST(Encoding, progressRisesToOne) {
  std::vector<double> reported;
  EncodeOptions options;
  options.progress = [&](double done) { reported.push_back(done); };
  (void)encoded(sampled("gyroid", {40, 40, 40}, gyroid()), options);
  ASSERT_FALSE(reported.empty());
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_GE(reported.front(), 0);
  EXPECT_EQ(reported.back(), 1);
}

TEST(Encoding, anEmptySurfaceIsAStream) {
  for (const Size& size : {Size{1, 1, 1}, Size{2, 2, 2}, Size{33, 40, 17}}) {
    for (double value : {-1.0, 0.0, 1.0}) {
      const Bytes bytes =
          encoded(sampled("constant", size, [=](double, double, double) { return value; }));
      EXPECT_LT(bytes.size(), 200u);
      const Decoder decoder = decoderOf(bytes);
      EXPECT_TRUE(decoder.isFinal());
      EXPECT_EQ(decoder.info().vertices, 0u);
      EXPECT_EQ(decoder.level(), decoder.levels() - 1);
      for (const Polygonizer polygonizer : kPolygonizers)
        EXPECT_TRUE(meshOf(decoder, {polygonizer, Frame::World, true}).positions.empty());
    }
  }
}

TEST(Encoding, statesItsOptionsInTheStream) {
  SampledField field = small();
  field.placement.spacing = {0.1, 0.2, 1e-3};
  field.placement.origin = {-1e6, 0.1, 7};
  field.placement.direction = {0, 1, 0, 0.6, 0, -0.8, 0.8, 0, 0.6};
  EncodeOptions options;
  options.isovalue = 0.1;
  options.maxError = 0.125;
  options.polygonizer = Polygonizer::Tetrahedra;
  const StreamInfo info = decoderOf(encoded(field, options)).info();
  EXPECT_EQ(info.version, kFormatVersion);
  EXPECT_EQ(info.size, field.size);
  EXPECT_EQ(info.placement.spacing, field.placement.spacing);
  EXPECT_EQ(info.placement.origin, field.placement.origin);
  EXPECT_EQ(info.placement.direction, field.placement.direction);
  EXPECT_EQ(info.isovalues, std::vector<double>{0.1});
  EXPECT_EQ(info.maxError, 0.125);
  EXPECT_FALSE(info.lossless);
  EXPECT_EQ(info.polygonizer, Polygonizer::Tetrahedra);
}

TEST(Encoding, takesAnyFunctionOfAPointInTheWorld) {
  Placement placement;
  placement.origin = {-1, 2, 5};
  placement.spacing = {0.5, 0.25, 1};
  placement.direction = {0, 1, 0, -1, 0, 0, 0, 0, 1};
  const std::array<int32_t, 3> size{20, 40, 12};
  const auto samples =
      sampled([](double x, double y, double z) { return 3 - std::hypot(x - 4, y + 3, z - 10); },
              size, placement);
  Bytes bytes;
  ASSERT_EQ(encode(Volume{samples, size, placement}, {}, bytes), Error::None);
  const Mesh mesh = decoded(bytes);
  ASSERT_GT(verticesOf(mesh), 100u);
  for (uint32_t i = 0; i < verticesOf(mesh); ++i) {
    const Point p = pointAt(mesh.positions, i);
    EXPECT_NEAR(std::hypot(p[0] - 4, p[1] + 3, p[2] - 10), 3, 0.1);
  }
  EXPECT_TRUE(sampled([](double, double, double) { return 0.0; }, {4, 0, 4}).empty());
}

}  // namespace
}  // namespace isostar
