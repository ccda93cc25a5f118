#include "byte_string.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

struct Page {
  uint32_t width, height;
  std::string samples;
};

/// A little-endian TIFF with one strip of bytes a page.
std::string tiff(const std::vector<Page>& pages, uint16_t samplesPerPixel = 1) {
  std::string file = std::string("II*\0", 4) + std::string(4, '\0');
  size_t link = 4;
  for (const auto& [width, height, page] : pages) {
    const auto strip = static_cast<uint32_t>(file.size());
    file += page + std::string(page.size() % 2, '\0');
    const auto directory = static_cast<uint32_t>(file.size());
    file.replace(link, 4, bytesOf(directory));
    const auto entry = [](uint16_t tag, uint16_t type, uint32_t value) {
      return bytesOf(tag) + bytesOf(type) + bytesOf(uint32_t{1}) + bytesOf(value);
    };
    file += bytesOf(uint16_t{9}) + entry(256, 4, width) + entry(257, 4, height) + entry(258, 3, 8) +
            entry(259, 3, 1) + entry(262, 3, samplesPerPixel == 3 ? 2 : 1) + entry(273, 4, strip) +
            entry(277, 3, samplesPerPixel) + entry(278, 4, height) +
            entry(279, 4, static_cast<uint32_t>(page.size()));
    link = file.size();
    file += std::string(4, '\0');
  }
  return file;
}

Page page(uint8_t first, uint32_t width = 2, uint32_t height = 3) {
  std::string samples;
  for (uint32_t i = 0; i < width * height; ++i) samples += static_cast<char>(first + i);
  return {width, height, samples};
}

using Tiff = ScratchFolder;

TEST_F(Tiff, readsThePagesOfAFile) {
  const LoadedVolume volume =
      readPath(write("v.tif", tiff({page(0), page(6), page(12), page(18)})));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  expectCounting(volume.samples);
  expectPoint(volume.placement.spacing, 1, 1, 1);
  ASSERT_EQ(volume.remarks.size(), 1u);
}

TEST_F(Tiff, readsAFolderInTheOrderOfItsNumbers) {
  for (int k = 8; k < 12; ++k)
    write("slice" + std::to_string(k) + ".tif", tiff({page(static_cast<uint8_t>(6 * (k - 8)))}));
  write("notes.txt", "slices");
  const LoadedVolume volume = readPath(path(""));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  expectCounting(volume.samples);
}

TEST_F(Tiff, refusesSlicesOfDifferentSize) {
  write("1.tif", tiff({page(0)}));
  write("2.tif", tiff({page(0, 3, 2)}));
  EXPECT_NE(complaint(path("")).find("differs from"), std::string::npos);
}

TEST_F(Tiff, refusesPagesOfDifferentSize) {
  const std::string found =
      complaint(write("v.tif", tiff({page(0, 4, 4), page(0, 3, 5), page(0, 4, 4)})));
  EXPECT_NE(found.find("page 2 is 3 x 5, the first 4 x 4"), std::string::npos) << found;
}

TEST_F(Tiff, refusesPagesOfDifferentSamples) {
  std::string file = tiff({page(0), page(6), page(12)});
  // The last page's bits a sample, in the third entry of its directory.
  const size_t bits = file.rfind(bytesOf(uint16_t{258}));
  file.replace(bits + 8, 2, bytesOf(uint16_t{1}));
  const std::string found = complaint(write("v.tif", file));
  EXPECT_NE(found.find("page 3 has samples of another type"), std::string::npos) << found;
}

TEST_F(Tiff, readsOnePageAsAnImageFromZeroToOne) {
  const LoadedVolume grey = readPath(write("v.tif", tiff({{2, 1, std::string("\x33\xFF", 2)}})));
  EXPECT_EQ(grey.dimension, 2);
  EXPECT_EQ(grey.size, (std::array<int32_t, 3>{2, 1, 1}));
  EXPECT_EQ(grey.samples, (std::vector<float>{0.2F, 1}));
  const LoadedVolume colours =
      readPath(write("v.tif", tiff({{3, 1, std::string("\xFF\0\0\0\xFF\0\0\0\xFF", 9)}}, 3)));
  EXPECT_EQ(colours.samples, (std::vector<float>{54 / 255.0F, 182 / 255.0F, 18 / 255.0F}))
      << "luminance";
}

TEST_F(Tiff, refusesColoursInAStackAndCutFiles) {
  EXPECT_NE(complaint(write("v.tif", tiff({{2, 1, "rgbrgb"}, {2, 1, "rgbrgb"}}, 3)))
                .find("3 values per sample"),
            std::string::npos);
  const std::string whole = tiff({page(0), page(6)});
  for (size_t length = 0; length + 1 < whole.size(); ++length)
    EXPECT_NE(complaint(write("v.tif", whole.substr(0, length))), "") << "cut at " << length;
}

}  // namespace
}  // namespace isostar::native
