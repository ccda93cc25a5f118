#include "byte_string.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

const std::string kHeader =
    "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = "
    "False\nCompressedData = False\n"
    "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 0.5 2 3\nDimSize = "
    "2 3 4\n"
    "ElementType = MET_SHORT\n";

class MetaImage : public ScratchFolder {
 protected:
  static void expectVolume(const LoadedVolume& volume) {
    EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
    expectCounting(volume.samples);
    // The rows of the matrix are the axes' directions.
    expectPoint(worldOf(volume.placement, 1, 0, 0), 10, 20.5, 30);
    expectPoint(worldOf(volume.placement, 0, 1, 0), 8, 20, 30);
    expectPoint(worldOf(volume.placement, 0, 0, 1), 10, 20, 33);
  }
};

TEST_F(MetaImage, readsOneFile) {
  expectVolume(readPath(
      write("v.mha", kHeader + "ElementDataFile = LOCAL\n" + bytesOf(counting<int16_t>(24)))));
}

TEST_F(MetaImage, readsTwoFiles) {
  write("v.raw", bytesOf(counting<int16_t>(24)));
  expectVolume(readPath(write("v.mhd", kHeader + "ElementDataFile = v.raw\n")));
}

TEST_F(MetaImage, refusesCutFiles) {
  const std::string whole = kHeader + "ElementDataFile = LOCAL\n" + bytesOf(counting<int16_t>(24));
  for (size_t length = 0; length < whole.size(); length += 3)
    EXPECT_NE(complaint(write("v.mha", whole.substr(0, length))), "") << "cut at " << length;
  EXPECT_NE(complaint(write("v.mhd", kHeader + "ElementDataFile = missing.raw\n")), "");
}

}  // namespace
}  // namespace isostar::native
