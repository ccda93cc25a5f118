// Volumes that change in time: one surface in four dimensions, cut at a time (§6).
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

/// A scalar by sample coordinates and frame.
using MovingField = std::function<double(double, double, double, double)>;

struct SampledSequence {
  std::string name;
  Size size;
  int32_t frames;
  std::vector<float> samples{};
  Placement placement{};

  [[nodiscard]] Sequence sequence() const { return {samples, size, frames, placement}; }
  [[nodiscard]] SampledField frame(int32_t t) const {
    const std::size_t length = samples.size() / static_cast<std::size_t>(frames);
    const auto first =
        samples.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(t) * length);
    return {name, size, {first, first + static_cast<std::ptrdiff_t>(length)}, placement};
  }
};

SampledSequence sampledSequence(std::string name, const Size& size, int32_t frames,
                                const MovingField& field) {
  SampledSequence result{std::move(name), size, frames};
  for (int32_t t = 0; t < frames; ++t) {
    const SampledField frame =
        sampled("", size, [&](double x, double y, double z) { return field(x, y, z, t); });
    result.samples.insert(result.samples.end(), frame.samples.begin(), frame.samples.end());
  }
  return result;
}

/// A ball that grows by half a sample per frame.
double ball(double x, double y, double z, double t) {
  return 2.3 + 0.5 * t - std::hypot(x - 8, y - 7, z - 7.5);
}

std::vector<SampledSequence> sequences() {
  auto travelling = [](double x, double y, double z, double t) {
    return gyroid(9)(x + 0.6 * t, y, z - 0.3 * t);
  };
  return {sampledSequence("ball", {17, 15, 16}, 6, ball),
          sampledSequence("gyroid", {12, 9, 14}, 5, travelling),
          sampledSequence("whole numbers", {10, 11, 9}, 9,
                          [=](double x, double y, double z, double t) {
                            return std::round(90 * travelling(x, y, z, t));
                          }),
          sampledSequence(
              "noise", {6, 7, 5}, 4,
              [](double x, double y, double z, double t) { return noise(9)(x, y, z + 100 * t); }),
          sampledSequence("two frames", {5, 4, 6}, 2, [](double x, double y, double z, double t) {
            return noise(2)(x, y, z + 50 * t);
          })};
}

Bytes encoded(const SampledSequence& sequence, const EncodeOptions& options = {}) {
  Bytes bytes;
  EXPECT_EQ(encode(sequence.sequence(), options, bytes), Error::None) << sequence.name;
  return bytes;
}

MeshOptions at(double time, Polygonizer polygonizer = Polygonizer::Cubes) {
  return {polygonizer, Frame::Grid, false, time};
}

/// Expects the same triangles, and vertices that are no further apart than a bound.
void expectNear(const Mesh& found, const Mesh& expected, double bound) {
  ASSERT_EQ(found.indices, expected.indices);
  ASSERT_EQ(found.positions.size(), expected.positions.size());
  for (std::size_t i = 0; i < found.positions.size(); ++i)
    EXPECT_NEAR(found.positions[i], expected.positions[i], bound);
}

TEST(SequenceSurface, eachFrameIsItsVolumesSurfaceWhenLossless) {
  for (const SampledSequence& sequence : sequences()) {
    for (const Polygonizer polygonizer : kPolygonizers) {
      EncodeOptions options;
      options.lossless = true;
      options.polygonizer = polygonizer;
      const Decoder decoder = decoderOf(encoded(sequence, options));
      EXPECT_EQ(decoder.error(), Error::None);
      EXPECT_TRUE(decoder.isFinal());
      for (int32_t t = 0; t < sequence.frames; ++t) {
        SCOPED_TRACE(sequence.name + ", frame " + std::to_string(t) + ", " + named(polygonizer));
        expectNear(meshOf(decoder, at(t, polygonizer)),
                   sourceMesh(sequence.frame(t), at(0, polygonizer)), 1e-5);
      }
    }
  }
}

TEST(SequenceSurface, keepsTheBoundOnFrames) {
  for (const SampledSequence& sequence : sequences()) {
    for (const double bound : {0.2, 0.02}) {
      EncodeOptions options;
      options.maxError = bound;
      const Decoder decoder = decoderOf(encoded(sequence, options));
      for (int32_t t = 0; t < sequence.frames; ++t) {
        SCOPED_TRACE(sequence.name + ", frame " + std::to_string(t));
        expectNear(meshOf(decoder, at(t)), sourceMesh(sequence.frame(t), at(0)), bound + 1e-5);
      }
    }
  }
}

TEST(SequenceSurface, isCutBetweenFrames) {
  const SampledSequence sequence = sequences()[0];
  EncodeOptions options;
  options.maxError = 0.01;
  const Decoder decoder = decoderOf(encoded(sequence, options));
  for (double time = 0; time <= 5; time += 0.125) {
    const Mesh mesh = meshOf(decoder, at(time));
    expectClosed(mesh, sequence.size);
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
      // The field is not linear, and between frames not all scalars are known.
      EXPECT_NEAR(ball(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2], time), 0,
                  0.15)
          << time;
    }
  }
}

TEST(SequenceSurface, movesWithoutJumps) {
  for (const SampledSequence& sequence : sequences()) {
    if (sequence.name == "whole numbers")
      continue;  // some samples equal the isovalue, and are positive just before
    EncodeOptions options;
    options.lossless = true;
    const Decoder decoder = decoderOf(encoded(sequence, options));
    for (int32_t t = 0; t < sequence.frames; ++t) {
      const Mesh there = meshOf(decoder, at(t));
      for (const double beside : {t - 1e-7, t + 1e-7}) {
        if (beside < 0 || beside > sequence.frames - 1) continue;
        SCOPED_TRACE(sequence.name + ", time " + std::to_string(beside));
        expectNear(meshOf(decoder, at(beside)), there, 1e-3);
      }
    }
  }
}

TEST(SequenceSurface, eachPrefixShowsEachTime) {
  for (const SampledSequence& sequence : {sequences()[3], sequences()[4]}) {
    const Bytes bytes = encoded(sequence);
    for (std::size_t length = 0; length <= bytes.size(); length += length < 60 ? 1 : 7) {
      const Decoder decoder = decoderOf(std::span(bytes).first(length));
      EXPECT_EQ(decoder.error(), length < bytes.size() ? Error::Truncated : Error::None) << length;
      if (!decoder.ready()) continue;
      for (const double time : {0.0, 0.4, 1.0}) {
        for (const Polygonizer polygonizer : kPolygonizers)
          expectClosed(meshOf(decoder, at(time, polygonizer)), sequence.size);
      }
    }
  }
}

TEST(SequenceSurface, sourceAndStreamAreCutTheSameWay) {
  const SampledSequence sequence = sequences()[2];
  EncodeOptions options;
  options.lossless = true;
  const Decoder decoder = decoderOf(encoded(sequence, options));
  for (const double time : {0.0, 0.3, 4.5, 7.99, 8.0}) {
    Mesh mesh;
    ASSERT_EQ(polygonize(sequence.sequence(), 0, at(time), mesh), Error::None);
    expectNear(meshOf(decoder, at(time)), mesh, 1e-6);
  }
}

TEST(SequenceSurface, otherTimesAreRefused) {
  const SampledSequence sequence = sequences()[4];
  const Decoder decoder = decoderOf(encoded(sequence));
  EXPECT_EQ(decoder.info().dimension, 4);
  EXPECT_EQ(decoder.info().frames, 2);
  Mesh mesh;
  for (const double time : {-0.01, 1.01, std::nan(""), 1e300}) {
    EXPECT_EQ(decoder.mesh(at(time), mesh), Error::BadArgument);
    EXPECT_EQ(polygonize(sequence.sequence(), 0, at(time), mesh), Error::BadArgument);
  }
}

}  // namespace
}  // namespace isostar
