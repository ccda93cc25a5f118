// What a decoder may do with untrusted input: show sound surfaces within its limits and report
// errors.
#pragma once

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

/// Decodes all layers and makes all surfaces after each; returns the decoder.
inline Decoder harmlesslyDecoded(std::span<const std::byte> bytes, const Limits& limits = kTight) {
  const Bytes copy(bytes.begin(), bytes.end());
  Decoder decoder(limits);
  decoder.accept(copy);
  decoder.finish();
  while (decoder.advance()) {
    for (const Polygonizer polygonizer : kPolygonizers) {
      for (const double isovalue : isovaluesToShow(decoder.info())) {
        MeshOptions options{polygonizer, Frame::World, true};
        options.isovalue = isovalue;
        showHarmlessly(decoder, options, limits);
        options.time = 0.7;  // between two frames
        if (decoder.info().frames > 1) showHarmlessly(decoder, options, limits);
      }
    }
  }
  EXPECT_TRUE(decoder.isFinal() || decoder.error() != Error::None);
  EXPECT_LE(decoder.bytes(), bytes.size());
  Mesh mesh;
  EXPECT_EQ(decoder.mesh({}, mesh) == Error::Truncated, !decoder.ready());
  return decoder;
}

}  // namespace isostar
