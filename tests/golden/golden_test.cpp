// Streams of yesterday decode to yesterday's surfaces. See README.md before one of these is
// changed.
#include <gtest/gtest.h>

#include <iostream>
#include <set>

#include "golden_sources.h"
#include "golden_table.h"

namespace isostar {
namespace {

const std::string kFolder = ISOSTAR_GOLDEN;

std::string pathOf(const std::string& name) {
  return kFolder + "/" + name + ".isostar";
}

TEST(Golden, streamsDecodeToTheSurfacesOfTheTable) {
  const auto table = goldenTable(kFolder + "/" + kGoldenTable);
  ASSERT_FALSE(table.empty());
  std::vector<GoldenSurface> found;
  std::string last;
  for (const GoldenSurface& row : table) {
    if (row.stream == last) continue;
    last = row.stream;
    const auto surfaces = surfacesOf(last, goldenBytes(pathOf(last)));
    EXPECT_FALSE(surfaces.empty()) << last << " does not decode";
    found.insert(found.end(), surfaces.begin(), surfaces.end());
  }
  ASSERT_EQ(found.size(), table.size());
  for (std::size_t i = 0; i < table.size(); ++i) EXPECT_EQ(found[i], table[i]);
}

TEST(Golden, eachPartOfTheFormatHasAStream) {
  const auto table = goldenTable(kFolder + "/" + kGoldenTable);
  std::set<int> dimensions;
  bool lossless = false, tetrahedra = false, adaptive = false, topology = false, near = false,
       placed = false, trimmed = false, fitted = false;
  for (const GoldenSurface& row : table) {
    const auto bytes = goldenBytes(pathOf(row.stream));
    EXPECT_LE(bytes.size(), 3000u) << row.stream;
    StreamInfo info;
    ASSERT_EQ(inspect(bytes, info), Error::None) << row.stream;
    dimensions.insert(info.dimension);
    lossless = lossless || info.lossless;
    tetrahedra = tetrahedra || info.polygonizer == Polygonizer::Tetrahedra;
    adaptive = adaptive || info.adaptive;
    topology = topology || info.preservesTopology;
    near = near || info.isovalues.size() > 1;
    EXPECT_EQ(info.version, static_cast<int>(bytes[3]) >> 2 & 31) << row.stream;
    trimmed = trimmed || info.trimmed;
    fitted = fitted || info.effort == 2;
    placed = placed || info.placement.direction != Placement().direction;
  }
  EXPECT_EQ(dimensions, (std::set{2, 3, 4}));
  EXPECT_TRUE(lossless && tetrahedra && adaptive && topology && near && placed && trimmed &&
              fitted);
}

/// No error: an encoder may become better. But nobody should change what it writes without knowing.
TEST(Golden, itIsSaidWhereTheEncoderWritesOtherBytesNow) {
  for (const GoldenSource& source : goldenSources()) {
    std::vector<std::byte> today;
    ASSERT_EQ(source.encode(today), Error::None) << source.name;
    EXPECT_FALSE(surfacesOf(source.name, today).empty()) << source.name;
    const auto then = goldenBytes(pathOf(source.name));
    if (today != then)
      std::cout << "Note: the encoder writes " << source.name << " differently now, " << then.size()
                << " bytes then, " << today.size() << " now\n";
  }
}

}  // namespace
}  // namespace isostar
