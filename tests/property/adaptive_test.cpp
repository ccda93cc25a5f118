// Adaptive streams (§4.3, §5.1, §5.2): coarse simplices where they keep the bound, conforming at
// every prefix.
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

const std::array<double, 3> kCentre{39, 35, 41};
constexpr double kRadius = 30;

/// Large enough that coarse simplices are worth their bytes.
SampledField ball() {
  return sampled("ball", {80, 72, 84}, [](double x, double y, double z) {
    return kRadius -
           std::sqrt((x - kCentre[0]) * (x - kCentre[0]) + (y - kCentre[1]) * (y - kCentre[1]) +
                     (z - kCentre[2]) * (z - kCentre[2]));
  });
}

EncodeOptions adaptive(double maxError, Polygonizer polygonizer = Polygonizer::Cubes) {
  EncodeOptions options;
  options.maxError = maxError;
  options.adaptive = true;
  options.polygonizer = polygonizer;
  return options;
}

double furthestFromBall(const Mesh& mesh) {
  double most = 0;
  for (uint32_t i = 0; i < verticesOf(mesh); ++i) {
    Point p = pointAt(mesh.positions, i);
    for (std::size_t a = 0; a < 3; ++a) p[a] -= kCentre[a];
    most = std::max(most, std::abs(std::sqrt(dot(p, p)) - kRadius));
  }
  return most;
}

TEST(Adaptive, codesABallInFewBytesWithinItsBound) {
  const auto field = ball();
  for (const double maxError : {0.4, 0.2}) {
    EncodeOptions uniform = adaptive(maxError);
    uniform.adaptive = false;
    const Bytes bytes = encoded(field, adaptive(maxError));
    EXPECT_TRUE(infoOf(bytes).adaptive);
    EXPECT_LT(bytes.size(), encoded(field, uniform).size());
    const Mesh mesh = decoded(bytes, {Polygonizer::Cubes, Frame::Grid, true});
    expectSound(mesh);
    expectClosed(mesh, field.size);
    EXPECT_LE(furthestFromBall(mesh), maxError);
  }
}

TEST(Adaptive, eachPrefixIsClosed) {
  const auto field = ball();
  for (const Polygonizer polygonizer : kPolygonizers) {
    const Bytes bytes = encoded(field, adaptive(0.4, polygonizer));
    ASSERT_TRUE(infoOf(bytes).adaptive);
    for (std::size_t length = 0; length <= bytes.size();
         length += length + 41 < bytes.size() ? 41 : 1) {
      SCOPED_TRACE("the first " + std::to_string(length));
      const Decoder decoder = decoderOf(std::span(bytes).first(length));
      ASSERT_EQ(decoder.error(), length < bytes.size() ? Error::Truncated : Error::None);
      Mesh mesh;
      ASSERT_EQ(decoder.mesh({polygonizer, Frame::Grid, true}, mesh),
                decoder.ready() ? Error::None : Error::Truncated);
      expectSound(mesh);
      expectClosed(mesh, field.size);
    }
  }
}

TEST(Adaptive, neverTakesMoreThanUniform) {
  for (const Size& size : {Size{5, 4, 6}, Size{17, 16, 20}}) {
    for (const auto& field : fieldsOf(size)) {
      for (const double maxError : {0.05, 0.5}) {
        EncodeOptions uniform = adaptive(maxError);
        uniform.adaptive = false;
        const Bytes bytes = encoded(field, adaptive(maxError));
        EXPECT_LE(bytes.size(), encoded(field, uniform).size()) << described(field);
        const Mesh mesh = decoded(bytes);
        expectSound(mesh);
        expectClosed(mesh, field.size);
      }
    }
  }
}

TEST(Adaptive, refusesOptionsThatItCannotCombine) {
  const auto field = ball();
  EncodeOptions options = adaptive(0.1);
  options.lossless = true;
  Bytes bytes;
  EXPECT_EQ(encode(field.volume(), options, bytes), Error::BadArgument);
  EXPECT_TRUE(bytes.empty());
}

}  // namespace
}  // namespace isostar
