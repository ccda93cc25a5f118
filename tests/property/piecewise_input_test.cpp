// The surfaces do not depend on the pieces in which the bytes arrive.
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

/// What is shown after each layer: the prefix's length and the mesh.
struct Shown {
  uint64_t bytes;
  std::vector<float> positions;
  std::vector<uint32_t> triangles;
  friend bool operator==(const Shown&, const Shown&) = default;
};

std::vector<Shown> shownInPieces(const Bytes& bytes, std::size_t length) {
  std::vector<Shown> all;
  Decoder decoder;
  for (std::size_t at = 0; at < bytes.size(); at += length) {
    decoder.accept(std::span(bytes).subspan(at, std::min(length, bytes.size() - at)));
    while (decoder.advance()) {
      Mesh mesh = meshOf(decoder, {Polygonizer::Tetrahedra, Frame::World, false});
      all.push_back({decoder.bytes(), std::move(mesh.positions), std::move(mesh.indices)});
    }
    EXPECT_EQ(decoder.error(), Error::None);
  }
  EXPECT_TRUE(decoder.isFinal());
  return all;
}

TEST(PiecewiseInput, showsTheSameSurfacesInPiecesOfAnySize) {
  for (const auto& field : fieldsOf({20, 13, 17})) {
    const Bytes bytes = encoded(field);
    const auto whole = shownInPieces(bytes, bytes.size());
    for (std::size_t length : {1u, 7u, 1000u})
      EXPECT_EQ(shownInPieces(bytes, length), whole) << field.name << ", " << length;
  }
}

TEST(PiecewiseInput, isNoErrorBeforeTheEnd) {
  const Bytes bytes = encoded(sampled("gyroid", {20, 13, 17}, gyroid()));
  Decoder decoder;
  EXPECT_FALSE(decoder.advance());
  EXPECT_FALSE(decoder.ready());
  EXPECT_EQ(decoder.levels(), 0);
  EXPECT_EQ(decoder.level(), -1);
  decoder.accept({});
  decoder.accept(std::span(bytes).first(10));
  EXPECT_FALSE(decoder.advance());
  EXPECT_EQ(decoder.error(), Error::None);
  decoder.finish();
  EXPECT_FALSE(decoder.advance());
  EXPECT_EQ(decoder.error(), Error::Truncated);
}

TEST(PiecewiseInput, ignoresTrailingBytes) {
  Bytes bytes = encoded(sampled("gyroid", {20, 13, 17}, gyroid()));
  const std::size_t length = bytes.size();
  const Mesh expected = decoded(bytes);
  bytes.resize(length + 100, std::byte{0x55});
  const Decoder decoder = decoderOf(bytes);
  EXPECT_EQ(decoder.error(), Error::None);
  EXPECT_TRUE(decoder.isFinal());
  EXPECT_EQ(decoder.bytes(), length);
  EXPECT_EQ(meshOf(decoder).positions, expected.positions);
}

TEST(PiecewiseInput, bytesAfterTheEndChangeNothing) {
  const Bytes bytes = encoded(sampled("gyroid", {20, 13, 17}, gyroid()));
  Decoder decoder;
  decoder.accept(bytes);
  while (decoder.advance()) {
  }
  for (const bool finished : {false, true}) {
    if (finished) decoder.finish();
    decoder.accept(bytes);
    EXPECT_FALSE(decoder.advance());
    EXPECT_EQ(decoder.error(), Error::None);
    EXPECT_TRUE(decoder.isFinal());
    EXPECT_EQ(decoder.bytes(), bytes.size());
    EXPECT_EQ(meshOf(decoder).positions, decoded(bytes).positions);
  }
}

TEST(PiecewiseInput, ignoresBytesAfterFinish) {
  const Bytes bytes = encoded(sampled("gyroid", {20, 13, 17}, gyroid()));
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, bytes.size() / 2}) {
    Decoder decoder;
    decoder.accept(std::span(bytes).first(length));
    decoder.finish();
    decoder.accept(std::span(bytes).subspan(length));
    while (decoder.advance()) {
    }
    EXPECT_EQ(decoder.error(), Error::Truncated);
    EXPECT_LE(decoder.bytes(), length);
    EXPECT_EQ(decoder.ready(), length > 10);
  }
}

TEST(PiecewiseInput, emptyPiecesChangeNothing) {
  const Bytes bytes = encoded(sampled("gyroid", {20, 13, 17}, gyroid()));
  Decoder decoder;
  for (const std::byte& b : bytes) {
    decoder.accept({});
    decoder.accept({&b, 1});
    decoder.accept({});
    while (decoder.advance()) EXPECT_FALSE(decoder.bytes() == 0);
  }
  decoder.accept({});
  EXPECT_FALSE(decoder.advance());
  EXPECT_TRUE(decoder.isFinal());
  EXPECT_EQ(meshOf(decoder).positions, decoded(bytes).positions);
}

TEST(PiecewiseInput, isTruncatedWhenFinishedBeforeTheHeader) {
  const Bytes bytes = encoded(sampled("gyroid", {20, 13, 17}, gyroid()));
  for (std::size_t length = 0; length < 12; ++length) {
    Decoder decoder;
    decoder.accept(std::span(bytes).first(length));
    decoder.finish();
    decoder.finish();
    EXPECT_EQ(decoder.error(), Error::None) << "no byte has been decoded";
    EXPECT_FALSE(decoder.advance());
    EXPECT_EQ(decoder.error(), Error::Truncated);
    EXPECT_FALSE(decoder.ready());
    EXPECT_EQ(decoder.bytes(), 0u);
    Mesh mesh;
    Contours contours;
    EXPECT_EQ(decoder.mesh({}, mesh), Error::Truncated);
    EXPECT_EQ(decoder.contours({}, contours), Error::Truncated);
  }
}

TEST(PiecewiseInput, theFirstErrorStays) {
  const Bytes good = encoded(sampled("gyroid", {20, 13, 17}, gyroid()));
  Bytes bad = good;
  bad[good.size() / 2] ^= std::byte{1};
  Decoder decoder = decoderOf(bad);
  ASSERT_EQ(decoder.error(), Error::Corrupt);
  const uint64_t shown = decoder.bytes();
  const int level = decoder.level();
  const Mesh mesh = meshOf(decoder);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(decoder.advance());
    decoder.accept(good);
    decoder.finish();
    EXPECT_EQ(decoder.error(), Error::Corrupt);
    EXPECT_EQ(decoder.bytes(), shown);
    EXPECT_EQ(decoder.level(), level);
    EXPECT_EQ(meshOf(decoder).positions, mesh.positions);
  }
}

TEST(PiecewiseInput, isOverLimitWithMoreBytesThanMemory) {
  const Bytes bytes = encoded(sampled("noise", {20, 13, 17}, noise()));
  Limits limits;
  limits.memory = bytes.size() - 1;
  Decoder decoder(limits);
  decoder.accept(bytes);
  EXPECT_FALSE(decoder.advance());
  EXPECT_EQ(decoder.error(), Error::OverLimit);
}

TEST(PiecewiseInput, continuesInAMovedDecoder) {
  const Bytes bytes = encoded(sampled("gyroid", {20, 13, 17}, gyroid()));
  Decoder first;
  first.accept(std::span(bytes).first(bytes.size() / 2));
  while (first.advance()) {
  }
  Decoder second = std::move(first);
  second.accept(std::span(bytes).subspan(bytes.size() / 2));
  while (second.advance()) {
  }
  EXPECT_EQ(meshOf(second).positions, decoded(bytes).positions);
}

TEST(PiecewiseInput, aMeshCanBeMadeTwice) {
  const Decoder decoder = decoderOf(encoded(sampled("gyroid", {20, 13, 17}, gyroid())));
  Mesh mesh = meshOf(decoder);
  const Mesh first = mesh;
  ASSERT_EQ(decoder.mesh({}, mesh), Error::None);
  EXPECT_EQ(mesh.positions, first.positions);
  EXPECT_EQ(mesh.indices, first.indices);
}

}  // namespace
}  // namespace isostar
