// The example in docs/format.md is correct: it is read out of the page and decoded field by field.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "coding/codec_state.h"

namespace isostar {
namespace {

using Bytes = std::vector<std::byte>;

/// The hexadecimal bytes between the first two backticks of each table row of a section. Each row
/// is checked against the offset that it states.
Bytes exampleOf(const std::string& path) {
  Bytes bytes;
  bool inside = false;
  std::ifstream page(path);
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) inside = line == "## An example";
    const std::size_t first = line.find("| `"), last = line.find("` |");
    if (!inside || first == std::string::npos || last == std::string::npos) continue;
    EXPECT_EQ(std::stoul(line.substr(2)), bytes.size()) << line;
    for (std::size_t at = first + 3; at < last; at += 3)
      bytes.push_back(static_cast<std::byte>(std::stoul(line.substr(at, 2), nullptr, 16)));
  }
  return bytes;
}

Bytes example() {
  return exampleOf(ISOSTAR_DOCUMENTS "/format.md");
}

TEST(FormatDocument, headerOfTheExampleIsAsDescribed) {
  const Bytes bytes = example();
  ASSERT_EQ(bytes.size(), 81u);
  Header header;
  std::size_t used = 0;
  ASSERT_EQ(read(bytes, header, used), Error::None);
  EXPECT_EQ(used, 20u);
  EXPECT_EQ(header.dimension, 3);
  EXPECT_EQ(header.size, (Coordinates<4>{7, 6, 9, 1}));
  EXPECT_EQ(header.isovalue, 0.25);
  EXPECT_EQ(header.quantizationStep, 0x1p-27);
  EXPECT_EQ(header.maxError, 0.1);
  EXPECT_EQ(header.vertices, 50u);
  EXPECT_EQ(header.placement.spacing, (std::array{0.5, 0.5, 1.25}));
  EXPECT_EQ(header.placement.origin, Placement().origin);
  EXPECT_EQ(header.bytes, 61u);
  EXPECT_EQ(header.finestLevel(), 1);
  EXPECT_FALSE(header.lossless || header.adaptive || header.whole || header.keepsTopology);
  Bytes again;
  ByteWriter out(again);
  write(out, header);
  EXPECT_EQ(again, Bytes(bytes.begin(), bytes.begin() + 20));
}

struct ExpectedHead {
  std::size_t at;
  LayerKind kind;
  int level;
  double error;
  uint64_t bytes;
  uint32_t checksum;
};

TEST(FormatDocument, layersOfTheExampleAreAsDescribed) {
  const Bytes bytes = example();
  Header header;
  std::size_t used = 0, number = 0;
  ASSERT_EQ(read(bytes, header, used), Error::None);
  for (const ExpectedHead& expected :
       {ExpectedHead{20, LayerKind::Base, 0, 1, 4, 0x2965},
        ExpectedHead{29, LayerKind::Refinement, 1, 0.648, 5, 0xBA77},
        ExpectedHead{39, LayerKind::Exponents, 1, 0.0573, 14, 0xDFD0},
        ExpectedHead{58, LayerKind::Magnitudes, 1, 0.0170, 18, 0x0A13}}) {
    LayerHead head;
    ASSERT_EQ(read(std::span(bytes).subspan(expected.at), header, head, used), Error::None);
    EXPECT_EQ(used, 5u);
    EXPECT_EQ(head.kind, expected.kind);
    EXPECT_EQ(head.level, expected.level);
    EXPECT_NEAR(head.error, expected.error, 0.005 * expected.error);
    EXPECT_EQ(head.bytes, expected.bytes);
    EXPECT_EQ(head.checksum, expected.checksum);
    EXPECT_EQ(
        checksum(head, std::span(bytes).subspan(expected.at + used, expected.bytes), number++),
        expected.checksum);
  }
}

TEST(FormatDocument, passesOfTheExampleAreAsDescribed) {
  const Bytes bytes = example();
  const std::span<const std::byte> stream(bytes);
  GeometryPass<3> pass;
  ByteReader exponents(stream.subspan(44));
  ASSERT_TRUE(pass.read(exponents));
  EXPECT_EQ(exponents.position(), 1u);
  EXPECT_EQ(pass.members, Members::AxisEnds);
  EXPECT_EQ(pass.exponentRange, 3);
  pass.kind = LayerKind::Magnitudes;
  ByteReader magnitudePass(stream.subspan(63));
  ASSERT_TRUE(pass.read(magnitudePass));
  EXPECT_EQ(magnitudePass.position(), 74u - 63u);
  EXPECT_EQ(pass.members, Members::AxisEnds);
  EXPECT_FALSE(pass.selective);
  EXPECT_EQ(pass.most, 30);
  EXPECT_EQ(pass.allowed, (GeometryPass<3>::Allowed{0, 6553, 6553, 0, 2621, 0, 0, 0}));
}

TEST(FormatDocument, exampleDecodes) {
  Decoder decoder;
  decoder.accept(example());
  decoder.finish();
  while (decoder.advance()) {
  }
  EXPECT_EQ(decoder.error(), Error::None);
  EXPECT_TRUE(decoder.isFinal());
  Mesh mesh;
  ASSERT_EQ(decoder.mesh({}, mesh), Error::None);
  EXPECT_EQ(mesh.positions.size(), 3 * 50u);
}

TEST(FormatDocument, rangeCoderExampleIsAsDescribed) {
  constexpr std::array<std::pair<bool, uint32_t>, 7> kDecisions{{{true, 32768},
                                                                 {false, 16384},
                                                                 {true, 65512},
                                                                 {false, 60000},
                                                                 {true, 24},
                                                                 {false, 65512},
                                                                 {true, 1000}}};
  Bytes bytes;
  RangeEncoder encoder(bytes);
  for (const auto& [actual, probability] : kDecisions) encoder.bit(actual, probability);
  encoder.finish();
  EXPECT_EQ(bytes, (Bytes{std::byte{0x77}, std::byte{0xDB}, std::byte{0x5A}, std::byte{0xB5},
                          std::byte{0xC4}}));
  RangeDecoder decoder(bytes);
  for (const auto& [actual, probability] : kDecisions)
    EXPECT_EQ(decoder.bit(false, probability), actual);
  EXPECT_EQ(decoder.overrun(), 3u);
}

}  // namespace
}  // namespace isostar
