#include "container/layer_kind.h"

#include <gtest/gtest.h>

#include <string>

namespace isostar {
namespace {

constexpr std::array kKinds{LayerKind::Base,         LayerKind::Refinement,
                            LayerKind::Exponents,    LayerKind::Magnitudes,
                            LayerKind::Domain,       LayerKind::Displacement,
                            LayerKind::FurtherSigns, LayerKind::FurtherGeometry};

TEST(LayerKind, fillsThreeBits) {
  EXPECT_EQ(kKinds.size(), kLayerTraits.size());
  for (std::size_t value = 0; value < kKinds.size(); ++value)
    EXPECT_EQ(static_cast<std::size_t>(kKinds[value]), value);
}

TEST(LayerKind, isFurtherInTheTwoKindsOfFurtherIsovalues) {
  for (const LayerKind kind : kKinds)
    EXPECT_EQ(traitsOf(kind).isFurther,
              kind == LayerKind::FurtherSigns || kind == LayerKind::FurtherGeometry);
}

TEST(LayerKind, hasAPassExactlyInGeometryLayers) {
  for (const LayerKind kind : kKinds)
    EXPECT_EQ(traitsOf(kind).hasPass, std::string("geometry") == traitsOf(kind).name);
}

TEST(LayerKind, isNeverShownTornWithoutAnEarlierSurface) {
  EXPECT_EQ(traitsOf(LayerKind::Base).tornFrom, TornFrom::Never);
  EXPECT_EQ(traitsOf(LayerKind::FurtherSigns).tornFrom, TornFrom::Never);
  EXPECT_EQ(traitsOf(LayerKind::Domain).tornFrom, TornFrom::Never);
}

}  // namespace
}  // namespace isostar
