// Golden streams decode to the surfaces in surfaces.txt. See README.md before changing one.
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
  bool lossless = false, tetrahedra = false, adaptive = false, topology = false,
       severalIsovalues = false, placed = false, trimmed = false, fitted = false, chunks = false;
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
    severalIsovalues = severalIsovalues || info.isovalues.size() > 1;
    EXPECT_EQ(info.version, static_cast<int>(bytes[3]) >> 2 & 31) << row.stream;
    trimmed = trimmed || info.trimmed;
    fitted = fitted || info.effort == 2;
    chunks = chunks || info.chunkSide != 0;
    placed = placed || info.placement.direction != Placement().direction;
  }
  EXPECT_EQ(dimensions, (std::set{2, 3, 4}));
  EXPECT_TRUE(lossless && tetrahedra && adaptive && topology && severalIsovalues && placed &&
              trimmed && fitted && chunks);
}

/// Not an error, because an encoder may become better; but a change of its bytes should be known.
TEST(Golden, changesOfTheEncodersBytesAreNoted) {
  for (const GoldenSource& source : goldenSources()) {
    std::vector<std::byte> current;
    ASSERT_EQ(source.encode(current), Error::None) << source.name;
    EXPECT_FALSE(surfacesOf(source.name, current).empty()) << source.name;
    const auto golden = goldenBytes(pathOf(source.name));
    if (current != golden)
      std::cout << "Note: the encoder writes " << source.name << " differently: " << golden.size()
                << " bytes in the golden stream, " << current.size() << " now\n";
  }
}

}  // namespace
}  // namespace isostar
