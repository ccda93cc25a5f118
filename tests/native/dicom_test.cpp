#include <cstdio>

#include "byte_string.h"
#include "dicom_element.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

struct SliceAt {
  std::string position = "0\\0\\0", orientation = "1\\0\\0\\0\\1\\0", series = "1.2.3", slope = "1";
};

/// A CT slice of 2 × 2 shorts, `first` and the three numbers after it.
std::string slice(int number, int16_t first, const SliceAt& at) {
  const std::string explicitLittleEndian = "1.2.840.10008.1.2.1", ct = "1.2.840.10008.5.1.4.1.1.2";
  const std::string instance = "1.2.3.4." + std::to_string(number);
  const std::string meta = element(2, 1, "OB", std::string("\0\1", 2)) + element(2, 2, "UI", ct) +
                           element(2, 3, "UI", instance) +
                           element(2, 16, "UI", explicitLittleEndian);
  std::vector<int16_t> samples;
  for (int16_t i = 0; i < 4; ++i) samples.push_back(static_cast<int16_t>(first + i));
  return std::string(128, '\0') + "DICM" +
         element(2, 0, "UL", bytesOf(static_cast<uint32_t>(meta.size()))) + meta +
         element(8, 0x16, "UI", ct) + element(8, 0x18, "UI", instance) +
         element(8, 0x60, "CS", "CT") + element(0x20, 0x0d, "UI", "1.2") +
         element(0x20, 0x0e, "UI", at.series) + element(0x20, 0x13, "IS", std::to_string(number)) +
         element(0x20, 0x32, "DS", at.position) + element(0x20, 0x37, "DS", at.orientation) +
         element(0x28, 2, 1) + element(0x28, 4, "CS", "MONOCHROME2") + element(0x28, 0x10, 2) +
         element(0x28, 0x11, 2) + element(0x28, 0x30, "DS", "0.5\\0.25") +
         element(0x28, 0x100, 16) + element(0x28, 0x101, 16) + element(0x28, 0x102, 15) +
         element(0x28, 0x103, 1) + element(0x28, 0x1052, "DS", "0") +
         element(0x28, 0x1053, "DS", at.slope) + element(0x7fe0, 0x10, "OW", bytesOf(samples));
}

class Dicom : public ScratchFolder {
 protected:
  void add(const std::string& name, int number, int16_t first, const SliceAt& at) const {
    write(name, slice(number, first, at));
  }
};

TEST_F(Dicom, ordersSlicesByPositionNotByName) {
  add("c.dcm", 1, 0, {"10\\20\\30"});
  add("a", 3, 8, {"10\\20\\36"});
  add("b.dcm", 2, 4, {"10\\20\\33"});
  write("notes.txt", "three slices");
  const LoadedVolume volume = readPath(path(""));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 2, 3}));
  expectCounting(volume.samples);
  expectPoint(worldOf(volume.placement, 0, 0, 0), 10, 20, 30);
  expectPoint(worldOf(volume.placement, 1, 0, 0), 10.25, 20, 30);
  expectPoint(worldOf(volume.placement, 0, 1, 0), 10, 20.5, 30);
  expectPoint(worldOf(volume.placement, 0, 0, 1), 10, 20, 33);
}

TEST_F(Dicom, keepsATiltedGantry) {
  for (int k = 0; k < 3; ++k)
    add(std::to_string(k), k, static_cast<int16_t>(4 * k),
        {"0\\" + std::to_string(k) + "\\" + std::to_string(2 * k)});
  expectPoint(worldOf(readPath(path("")).placement, 0, 0, 2), 0, 2, 4);
}

TEST_F(Dicom, appliesEachSlicesSlope) {
  add("0", 0, 0, {"0\\0\\0"});
  add("1", 1, 4, {.position = "0\\0\\1", .slope = "0.5"});
  EXPECT_EQ(readPath(path("")).samples, (std::vector<float>{0, 1, 2, 3, 2, 2.5, 3, 3.5}));
}

TEST_F(Dicom, refusesAMissingSlice) {
  for (int k : {0, 1, 3, 4}) add(std::to_string(k), k, 0, {"0\\0\\" + std::to_string(k)});
  const std::string found = complaint(path(""));
  EXPECT_NE(found.find("slices 2 and 3 are 2 mm apart, the others 1"), std::string::npos) << found;
}

TEST_F(Dicom, takesTheLargestSeries) {
  add("scout", 9, 90, {.series = "1.2.9"});
  for (int k = 0; k < 2; ++k)
    add(std::to_string(k), k, static_cast<int16_t>(4 * k), {"0\\0\\" + std::to_string(k)});
  const LoadedVolume volume = readPath(path(""));
  expectCounting(volume.samples);
  ASSERT_EQ(volume.remarks.size(), 1u);
}

TEST_F(Dicom, refusesAFolderWithoutSlices) {
  EXPECT_NE(complaint(path("")).find("neither DICOM nor TIFF"), std::string::npos);
}

TEST_F(Dicom, refusesCutFiles) {
  const std::string whole = slice(1, 0, {});
  for (size_t length = 0; length < whole.size(); length += 7)
    EXPECT_NE(complaint(write("v.dcm", whole.substr(0, length))), "")
        << "cut at " << length << " of " << whole.size();
}

}  // namespace
}  // namespace isostar::native
