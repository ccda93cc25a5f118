#include "coding/geometry/geometry_pass.h"

#include <gtest/gtest.h>

namespace isostar {
namespace {

using Pass = GeometryPass<3>;

std::vector<std::byte> written(const Pass& pass) {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  pass.write(out);
  return bytes;
}

bool readBack(const std::vector<std::byte>& bytes, LayerKind kind, Pass& pass) {
  pass.kind = kind;
  ByteReader in(bytes);
  const bool sane = pass.read(in);
  EXPECT_EQ(in.position(), bytes.size());
  return sane;
}

TEST(GeometryPass, roundTripsItsFields) {
  Pass exponents;
  exponents.members = Members::DiagonalEnds;
  exponents.exponentRange = 32;
  Pass magnitudes;
  magnitudes.kind = LayerKind::Magnitudes;
  magnitudes.most = 30;
  magnitudes.selective = true;
  magnitudes.allowed = {0, 100, 100, 0, 100, 0, 0, 0};
  Pass uneven = magnitudes;
  uneven.allowed = {0, 1 << 20, 6553, 7, 2621, 1, 0, 13};
  Pass displacement;
  displacement.kind = LayerKind::Displacement;
  displacement.displacement = {3, 63};
  for (const Pass& pass : {exponents, magnitudes, uneven, displacement}) {
    Pass found;
    ASSERT_TRUE(readBack(written(pass), pass.kind, found));
    EXPECT_EQ(found.members, pass.members);
    if (pass.kind == LayerKind::Exponents) {
      EXPECT_EQ(found.exponentRange, pass.exponentRange);
    }
    if (pass.kind == LayerKind::Magnitudes) {
      EXPECT_EQ(found.allowed, pass.allowed);
      EXPECT_EQ(found.most, pass.most);
      EXPECT_EQ(found.selective, pass.selective);
    }
    if (pass.kind == LayerKind::Displacement) {
      EXPECT_EQ(found.displacement.log2Side, 3);
      EXPECT_EQ(found.displacement.step, 63);
    }
  }
}

TEST(GeometryPass, takesFewBytesWhereAxesAreAlike) {
  Pass pass;
  pass.kind = LayerKind::Magnitudes;
  pass.allowed = {0, 6553, 6553, 0, 6553, 0, 0, 0};
  EXPECT_EQ(written(pass).size(), 3u);
}

TEST(GeometryPass, refusesFieldsOutOfRange) {
  Pass pass;
  EXPECT_FALSE(readBack({std::byte{33 << 1}}, LayerKind::Exponents, pass));
  EXPECT_FALSE(readBack({std::byte{0}}, LayerKind::Displacement, pass)) << "no side, no step";
  EXPECT_FALSE(readBack({std::byte{3}}, LayerKind::Displacement, pass)) << "no step";
  EXPECT_FALSE(readBack({std::byte{33 << 2}, std::byte{1}}, LayerKind::Magnitudes, pass));
  Pass wide;
  wide.kind = LayerKind::Magnitudes;
  wide.allowed = {0, (1 << 20) + 1, 0, 0, 0, 0, 0, 0};
  EXPECT_FALSE(readBack(written(wide), LayerKind::Magnitudes, pass));
}

}  // namespace
}  // namespace isostar
