// Round trips through the public API: volume to stream, stream to mesh.
#pragma once

#include <gtest/gtest.h>

#include "sampled_field.h"

namespace isostar {

using Bytes = std::vector<std::byte>;

inline const std::array kPolygonizers{Polygonizer::Cubes, Polygonizer::Tetrahedra};

inline std::string named(Polygonizer polygonizer) {
  return polygonizer == Polygonizer::Cubes ? "cubes" : "tetrahedra";
}

inline Bytes encoded(const SampledField& field, const EncodeOptions& options = {}) {
  Bytes bytes;
  EXPECT_EQ(encode(field.volume(), options, bytes), Error::None) << described(field);
  return bytes;
}

inline StreamInfo infoOf(const Bytes& bytes) {
  StreamInfo info;
  EXPECT_EQ(inspect(bytes, info), Error::None);
  return info;
}

/// A decoder that has received a prefix and finish(), and has advanced as far as it can. It decodes
/// a copy of exactly the right length, so that the address sanitizer sees an overrun.
inline Decoder decoderOf(std::span<const std::byte> prefix, const Limits& limits = {}) {
  const Bytes copy(prefix.begin(), prefix.end());
  Decoder decoder(limits);
  decoder.accept(copy);
  decoder.finish();
  while (decoder.advance()) {
  }
  return decoder;
}

inline Mesh meshOf(const Decoder& decoder, const MeshOptions& options = {}) {
  Mesh mesh;
  EXPECT_EQ(decoder.mesh(options, mesh), Error::None);
  return mesh;
}

inline Mesh decoded(std::span<const std::byte> bytes, const MeshOptions& options = {}) {
  const Decoder decoder = decoderOf(bytes);
  EXPECT_EQ(decoder.error(), Error::None);
  EXPECT_TRUE(decoder.isFinal());
  return meshOf(decoder, options);
}

/// The source's own surface.
inline Mesh sourceMesh(const SampledField& field, const MeshOptions& options = {},
                       double isovalue = 0) {
  Mesh mesh;
  EXPECT_EQ(polygonize(field.volume(), isovalue, options, mesh), Error::None) << described(field);
  return mesh;
}

/// The same triangles, and vertices no further apart on any axis than `bound`.
inline void expectSameMesh(const Mesh& mesh, const Mesh& expected, double bound) {
  EXPECT_EQ(mesh.indices, expected.indices);
  ASSERT_EQ(mesh.positions.size(), expected.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    ASSERT_NEAR(mesh.positions[i], expected.positions[i], bound);
}

}  // namespace isostar
