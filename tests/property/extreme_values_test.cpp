// What encode() promises holds against the samples' own crossings, whatever their values; or it
// refuses.
#include <limits>
#include <random>

#include "exact_crossings.h"

namespace isostar {
namespace {

constexpr double kLossless = 1.0 / (1 << 14);
/// Positions are 32-bit floats.
constexpr double kRounding = 2e-6;

/// Returns whether a stream was written.
bool holdsOrRefuses(const SampledField& field, const EncodeOptions& options) {
  Bytes bytes;
  EncodeReport report;
  const Error error = encode(field.volume(), options, bytes, &report);
  if (error != Error::None) {
    EXPECT_EQ(error, Error::BadArgument);
    EXPECT_FALSE(report.holds);
    EXPECT_TRUE(bytes.empty());
    return false;
  }
  EXPECT_TRUE(report.holds || options.bestEffort);
  const StreamInfo info = infoOf(bytes);
  const double bound = info.lossless ? kLossless : info.maxError;
  const Decoder decoder = decoderOf(bytes);
  EXPECT_TRUE(decoder.isFinal());
  for (const double isovalue : info.isovalues) {
    MeshOptions grid{Polygonizer::Cubes, Frame::Grid, false};
    grid.isovalue = isovalue;
    EXPECT_LE(farthestFromExact(meshOf(decoder, grid), field, isovalue), bound + kRounding * 32)
        << field.name << " at " << isovalue;
  }
  return true;
}

/// A smooth field around ±1 whose samples beyond a plane have a fill value.
SampledField filled(float fill) {
  auto field = sampled("fill " + std::to_string(fill), {24, 20, 22}, gyroid(9));
  for (std::size_t i = 0; i < field.samples.size(); ++i)
    if (i % 24 > 17) field.samples[i] = fill;
  return field;
}

TEST(ExtremeValues, fillValuesBesideASurfaceKeepTheBound) {
  for (const float fill : {-3.4e38F, 9.96921e36F, 1e10F, -1e6F, -9999.F, 1e-40F, 0.F})
    EXPECT_TRUE(holdsOrRefuses(filled(fill), {})) << fill;
}

TEST(ExtremeValues, losslessHoldsBesideFillValuesOrIsRefused) {
  EncodeOptions options;
  options.lossless = true;
  // 29 bits cannot hold both the fill value and the smallest differences beside it.
  for (const float fill : {-3.4e38F, 1e10F, -9999.F})
    EXPECT_FALSE(holdsOrRefuses(filled(fill), options));
  for (const float fill : {-20.F, 3.F}) EXPECT_TRUE(holdsOrRefuses(filled(fill), options));
}

TEST(ExtremeValues, furtherIsovaluesHoldOrAreRefused) {
  for (const bool lossless : {false, true}) {
    for (const float fill : {1e10F, -9999.F, 0.25F}) {
      EncodeOptions options;
      options.lossless = lossless;
      options.furtherIsovalues = {0.1, -0.3};
      holdsOrRefuses(filled(fill), options);
    }
  }
}

/// Samples of every magnitude that a float has, denormal ones, ties and plateaus.
SampledField wild(std::mt19937& random, double decades) {
  std::uniform_real_distribution<double> exponent(-decades, decades);
  SampledField field{"wild", {9, 10, 8}, std::vector<float>(720)};
  for (float& s : field.samples) {
    const double size = std::pow(10.0, std::clamp(exponent(random), -44.0, 38.0));
    s = static_cast<float>(random() % 2 == 0 ? size : -size);
    if (random() % 16 == 0) s = 0;
  }
  return field;
}

TEST(ExtremeValues, wildSamplesHoldOrAreRefused) {
  std::mt19937 random(7);
  int written = 0;
  for (const double decades : {0.5, 1.0, 2.0, 4.0, 10.0, 44.0}) {
    for (int i = 0; i < 20; ++i) {
      EncodeOptions options;
      options.lossless = i % 4 == 0;
      options.maxError = i % 3 == 0 ? 0.01 : 0.2;
      written += holdsOrRefuses(wild(random, decades), options) ? 1 : 0;
    }
  }
  EXPECT_GE(written, 50);
}

TEST(ExtremeValues, bestEffortStatesTheBoundThatItHolds) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    EncodeOptions options;
    options.lossless = i % 2 == 0;
    options.bestEffort = true;
    EXPECT_TRUE(holdsOrRefuses(wild(random, 20), options));
  }
}

TEST(ExtremeValues, polygonizeIsExactOrRefuses) {
  std::mt19937 random(5);
  int refused = 0;
  for (const double decades : {1.0, 4.0, 10.0, 20.0}) {
    for (int i = 0; i < 20; ++i) {
      const SampledField field = wild(random, decades);
      Mesh mesh;
      const Error error =
          polygonize(field.volume(), 0, {Polygonizer::Cubes, Frame::Grid, false}, mesh);
      refused += error != Error::None;
      if (error == Error::None)
        EXPECT_LE(farthestFromExact(mesh, field, 0), kLossless + kRounding * 32);
      else
        EXPECT_EQ(error, Error::BadArgument);
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 80);
}

TEST(ExtremeValues, featuresOfOneSampleAreKept) {
  for (const float bump : {1e-30F, 1e-3F, 1.F, 1e20F}) {
    SampledField field{"bump", {7, 7, 7}, std::vector<float>(343, -1.F)};
    field.samples[171] = bump;
    EXPECT_TRUE(holdsOrRefuses(field, {})) << bump;
  }
}

}  // namespace
}  // namespace isostar
