#include "byte_string.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

/// A little-endian TIFF with one strip of bytes a page.
std::string tiff(uint32_t width, uint32_t height, const std::vector<std::string>& pages, uint16_t samplesPerPixel = 1) {
  std::string file = std::string("II*\0", 4) + std::string(4, '\0');
  size_t link = 4;
  for (const std::string& page : pages) {
    const auto strip = static_cast<uint32_t>(file.size());
    file += page + std::string(page.size() % 2, '\0');
    const auto directory = static_cast<uint32_t>(file.size());
    file.replace(link, 4, bytesOf(directory));
    const auto entry = [](uint16_t tag, uint16_t type, uint32_t value) {
      return bytesOf(tag) + bytesOf(type) + bytesOf(uint32_t{1}) + bytesOf(value);
    };
    file += bytesOf(uint16_t{9}) + entry(256, 4, width) + entry(257, 4, height) + entry(258, 3, 8) + entry(259, 3, 1) +
            entry(262, 3, samplesPerPixel == 3 ? 2 : 1) + entry(273, 4, strip) + entry(277, 3, samplesPerPixel) +
            entry(278, 4, height) + entry(279, 4, static_cast<uint32_t>(page.size()));
    link = file.size();
    file += std::string(4, '\0');
  }
  return file;
}

std::string page(uint8_t first) {
  std::string samples;
  for (int i = 0; i < 6; ++i) samples += static_cast<char>(first + i);
  return samples;
}

using Tiff = ScratchFolder;

TEST_F(Tiff, readsThePagesOfAFile) {
  const LoadedVolume volume = readPath(write("v.tif", tiff(2, 3, {page(0), page(6), page(12), page(18)})));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  expectCounting(volume.samples);
  expectPoint(volume.placement.spacing, 1, 1, 1);
  ASSERT_EQ(volume.remarks.size(), 1u);
}

TEST_F(Tiff, readsAFolderInTheOrderOfItsNumbers) {
  for (int k = 8; k < 12; ++k)
    write("slice" + std::to_string(k) + ".tif", tiff(2, 3, {page(static_cast<uint8_t>(6 * (k - 8)))}));
  write("notes.txt", "slices");
  const LoadedVolume volume = readPath(path(""));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  expectCounting(volume.samples);
}

TEST_F(Tiff, refusesSlicesOfDifferentSize) {
  write("1.tif", tiff(2, 3, {page(0)}));
  write("2.tif", tiff(3, 2, {page(0)}));
  EXPECT_NE(complaint(path("")).find("differs from"), std::string::npos);
}

TEST_F(Tiff, refusesColoursAndCutFiles) {
  EXPECT_NE(complaint(write("v.tif", tiff(2, 1, {page(0)}, 3))).find("3 values a sample"), std::string::npos);
  const std::string whole = tiff(2, 3, {page(0), page(6)});
  for (size_t length = 0; length + 1 < whole.size(); ++length)
    EXPECT_NE(complaint(write("v.tif", whole.substr(0, length))), "") << "cut at " << length;
}

}  // namespace
}  // namespace isostar::native
