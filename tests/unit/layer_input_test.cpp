#include "decoder/layer_input.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

using Bytes = std::vector<std::byte>;

/// The bytes of a layer: the fields of a pass, then three coded bytes.
Bytes layerOf(const GeometryPass<3>& pass) {
  Bytes bytes;
  ByteWriter out(bytes);
  pass.write(out);
  for (const int coded : {7, 8, 9}) bytes.push_back(static_cast<std::byte>(coded));
  return bytes;
}

GeometryPass<3> magnitudes() {
  GeometryPass<3> pass;
  pass.kind = LayerKind::Magnitudes;
  pass.allowed = {0, 6553, 100, 0, 2621, 0, 0, 1};
  pass.most = 30;
  return pass;
}

TEST(LayerInput, separatesTheFieldsFromTheCodedBits) {
  const Bytes bytes = layerOf(magnitudes());
  LayerInput<3> input;
  ASSERT_FALSE(input.read(LayerKind::Magnitudes, bytes, false));
  EXPECT_EQ(input.pass.allowed, magnitudes().allowed);
  EXPECT_EQ(input.pass.most, 30);
  ASSERT_EQ(input.coded.size(), 3u);
  EXPECT_EQ(input.coded[0], std::byte{7});
}

TEST(LayerInput, takesAllBytesOfALayerWithoutAPass) {
  const Bytes bytes(5);
  LayerInput<3> input;
  ASSERT_FALSE(input.read(LayerKind::Refinement, bytes, false));
  EXPECT_EQ(input.coded.size(), 5u);
}

TEST(LayerInput, readsTheKindOfAPassOfAFurtherIsovalue) {
  Bytes bytes = layerOf(magnitudes());
  bytes.insert(bytes.begin(), static_cast<std::byte>(LayerKind::Magnitudes));
  LayerInput<3> input;
  ASSERT_FALSE(input.read(LayerKind::FurtherGeometry, bytes, false));
  EXPECT_EQ(input.pass.kind, LayerKind::Magnitudes);
  EXPECT_EQ(input.pass.allowed, magnitudes().allowed);
  bytes[0] = static_cast<std::byte>(LayerKind::Displacement);
  const auto outcome = input.read(LayerKind::FurtherGeometry, bytes, false);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->error, Error::Corrupt);
}

TEST(LayerInput, isCorruptWithinTheFieldsUnlessItIsTorn) {
  const Bytes bytes = layerOf(magnitudes());
  for (std::size_t length = 0; length + 3 < bytes.size(); ++length) {
    LayerInput<3> input;
    for (const bool torn : {false, true}) {
      const auto outcome = input.read(LayerKind::Magnitudes, std::span(bytes).first(length), torn);
      ASSERT_TRUE(outcome) << length;
      EXPECT_EQ(outcome->error, torn ? Error::None : Error::Corrupt) << length;
    }
  }
}

}  // namespace
}  // namespace isostar
