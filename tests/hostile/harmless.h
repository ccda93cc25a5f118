// What a decoder may do with untrusted input: show sound surfaces within its limits and report
// errors.
#pragma once

#include "hostile/parts.h"
#include "property/round_trip.h"
#include "property/surface_checks.h"

namespace isostar {

/// Small limits, so that a test soon sees where they are exceeded.
inline constexpr Limits kTight{1u << 22, 1u << 18, 64u << 20};

/// The stream's own isovalues, and one between the first and the last.
inline std::vector<double> isovaluesToShow(const StreamInfo& info) {
  std::vector<double> isovalues = info.isovalues;
  if (isovalues.size() > 1) isovalues.push_back(0.7 * isovalues.front() + 0.3 * isovalues.back());
  return isovalues;
}

/// Both polygonizers, each isovalue, and a time on a frame and between two.
inline std::vector<MeshOptions> optionsToShow(const StreamInfo& info) {
  std::vector<MeshOptions> all;
  for (const Polygonizer polygonizer : kPolygonizers) {
    for (const double isovalue : isovaluesToShow(info)) {
      for (const double time : {0.0, 0.7}) {
        if (time == 0 || info.frames > 1)
          all.push_back({polygonizer, Frame::World, true, time, isovalue});
      }
    }
  }
  return all;
}

/// Makes the surface or the contours: sound, or over the limits.
inline void showHarmlessly(const Decoder& decoder, const MeshOptions& options,
                           const Limits& limits) {
  if (decoder.info().dimension == 2) {
    Contours contours;
    const Error error = decoder.contours(options, contours);
    EXPECT_TRUE(error == Error::None || error == Error::OverLimit) << name(error);
    for (const float v : contours.points) EXPECT_TRUE(std::isfinite(v));
    return;
  }
  Mesh mesh;
  const Error error = decoder.mesh(options, mesh);
  EXPECT_TRUE(error == Error::None || error == Error::OverLimit) << name(error);
  if (error == Error::None) expectSound(mesh);
  EXPECT_LE(verticesOf(mesh), limits.vertices);
}

/// What holds of a decoder that has decoded what it can of `length` bytes.
inline void expectEnded(const Decoder& decoder, std::size_t length) {
  EXPECT_TRUE(decoder.isFinal() || decoder.error() != Error::None);
  EXPECT_LE(decoder.bytes(), length);
  Mesh mesh;
  EXPECT_EQ(decoder.mesh({}, mesh) == Error::Truncated, !decoder.ready());
}

/// Decodes all layers and makes all surfaces after each; returns the decoder.
inline Decoder harmlesslyDecoded(std::span<const std::byte> bytes, const Limits& limits = kTight) {
  const Bytes copy(bytes.begin(), bytes.end());
  Decoder decoder(limits);
  decoder.accept(copy);
  decoder.finish();
  while (decoder.advance()) {
    for (const MeshOptions& options : optionsToShow(decoder.info()))
      showHarmlessly(decoder, options, limits);
  }
  expectEnded(decoder, bytes.size());
  return decoder;
}

/// Decodes a stream in chunks in parts, and makes one of their last surfaces, by `number`.
inline void decodePartsHarmlessly(std::span<const std::byte> bytes, std::size_t number) {
  if (!isInChunks(bytes)) return;
  const Decoder region = decodedRegion(bytes, kTight);
  EXPECT_TRUE(region.isFinal() || region.error() != Error::None);
  const auto options = optionsToShow(region.info());
  const MeshOptions& shown = options[number % options.size()];
  if (region.ready()) showHarmlessly(region, shown, kTight);
  for (const Decoder& share : decodedShares(bytes, kTight)) {
    Mesh mesh;
    std::vector<MeshRun> runs;
    const Error error = share.mesh(shown, mesh, runs);
    EXPECT_TRUE(error == Error::None || error == Error::OverLimit || !share.ready());
    for (const float v : mesh.positions) ASSERT_TRUE(std::isfinite(v));
  }
}

/// Decodes all layers and makes one of the last surfaces, by `number`, as a whole and in parts;
/// returns the decoder of the whole.
inline Decoder harmlesslyDecodedToTheEnd(std::span<const std::byte> bytes, std::size_t number) {
  Decoder decoder = decoderOf(bytes, kTight);
  const auto options = optionsToShow(decoder.info());
  if (decoder.ready()) showHarmlessly(decoder, options[number % options.size()], kTight);
  expectEnded(decoder, bytes.size());
  decodePartsHarmlessly(bytes, number);
  return decoder;
}

}  // namespace isostar
