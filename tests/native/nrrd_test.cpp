#include <zlib.h>

#include <limits>

#include "byte_string.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

std::string gzip(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string out(bytes.size() + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

class Nrrd : public ScratchFolder {
 protected:
  /// A volume of 2 × 3 × 4 counting shorts with further header lines.
  std::string shorts(const std::string& lines) const {
    return write(
        "v.nrrd",
        "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nencoding: raw\nendian: little\n" +
            lines + "\n" + bytesOf(counting<int16_t>(24)));
  }
};

TEST_F(Nrrd, readsRawSamples) {
  const LoadedVolume volume = readPath(shorts(""));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  ASSERT_EQ(volume.samples.size(), 24u);
  expectCounting(volume.samples);
  expectPoint(worldOf(volume.placement, 1, 1, 1), 1, 1, 1);
}

TEST_F(Nrrd, readsGzip) {
  write("v.nrrd",
        "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 3 4\nencoding: gzip\nendian: little\n\n" +
            gzip(bytesOf(counting<float>(24))));
  const LoadedVolume volume = readPath(path("v.nrrd"));
  ASSERT_EQ(volume.samples.size(), 24u);
  expectCounting(volume.samples);
}

TEST_F(Nrrd, readsBigEndian) {
  write("v.nrrd",
        "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: big\n\n" +
            std::string("\x01\x00\x00\x02", 4));
  EXPECT_EQ(readPath(path("v.nrrd")).samples, (std::vector<float>{256, 2}));
}

TEST_F(Nrrd, readsADetachedHeader) {
  write("v.raw", bytesOf(counting<uint8_t>(24)));
  write("v.nhdr",
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\ndata file: v.raw\n");
  expectCounting(readPath(path("v.nhdr")).samples);
}

TEST_F(Nrrd, keepsSpacings) {
  const LoadedVolume volume = readPath(shorts("spacings: 0.5 1 2.5\n"));
  expectPoint(worldOf(volume.placement, 1, 1, 1), 0.5, 1, 2.5);
}

TEST_F(Nrrd, keepsPermutedAxes) {
  const LoadedVolume volume =
      readPath(shorts("space: left-posterior-superior\nspace directions: (0,0,2) (3,0,0) "
                      "(0,4,0)\nspace origin: (7,8,9)\n"));
  expectPoint(worldOf(volume.placement, 0, 0, 0), 7, 8, 9);
  expectPoint(worldOf(volume.placement, 1, 0, 0), 7, 8, 11);
  expectPoint(worldOf(volume.placement, 0, 1, 0), 10, 8, 9);
  expectPoint(worldOf(volume.placement, 0, 0, 1), 7, 12, 9);
  expectPoint(volume.placement.spacing, 2, 3, 4);
}

TEST_F(Nrrd, keepsObliqueAxes) {
  const LoadedVolume volume =
      readPath(shorts("space: left-posterior-superior\nspace directions: (1.2,1.6,0) (-1.6,1.2,0) "
                      "(0,0,1)\nspace origin: (0,0,0)\n"));
  expectPoint(worldOf(volume.placement, 1, 0, 0), 1.2, 1.6, 0);
  expectPoint(worldOf(volume.placement, 0, 1, 0), -1.6, 1.2, 0);
  expectPoint(volume.placement.spacing, 2, 2, 1);
}

TEST_F(Nrrd, keepsLeftHandedAxes) {
  const LoadedVolume volume =
      readPath(shorts("space: left-posterior-superior\nspace directions: (-1,0,0) (0,1,0) "
                      "(0,0,2)\nspace origin: (5,0,0)\n"));
  expectPoint(worldOf(volume.placement, 1, 1, 1), 4, 1, 2);
}

TEST_F(Nrrd, turnsRightAnteriorIntoLps) {
  const LoadedVolume volume = readPath(
      shorts("space: RAS\nspace directions: (1,0,0) (0,2,0) (0,0,3)\nspace origin: (10,20,30)\n"));
  expectPoint(worldOf(volume.placement, 0, 0, 0), -10, -20, 30);
  expectPoint(worldOf(volume.placement, 1, 1, 1), -11, -22, 33);
}

TEST_F(Nrrd, readsTwoAxesAsAnImage) {
  write("v.nrrd",
        "NRRD0004\ntype: uchar\ndimension: 2\nsizes: 2 3\nencoding: raw\nspacings: 2 3\n\n" +
            bytesOf(counting<uint8_t>(6)));
  const LoadedVolume volume = readPath(path("v.nrrd"));
  EXPECT_EQ(volume.dimension, 2);
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 1}));
  expectPoint(worldOf(volume.placement, 1, 1, 1), 2, 3, 1);
}

TEST_F(Nrrd, refusesColoursAndFiveAxes) {
  write("v.nrrd",
        "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 2 2\nkinds: RGB-color domain domain "
        "domain\nencoding: raw\n\n" +
            std::string(24, 'x'));
  EXPECT_NE(complaint(path("v.nrrd")).find("3 values per sample"), std::string::npos)
      << complaint(path("v.nrrd"));
  write("v.nrrd", "NRRD0004\ntype: uchar\ndimension: 5\nsizes: 2 2 2 1 3\nencoding: raw\n\n" +
                      std::string(24, 'x'));
  EXPECT_NE(complaint(path("v.nrrd")).find("5 dimensions"), std::string::npos)
      << complaint(path("v.nrrd"));
}

TEST_F(Nrrd, readsFourAxesAsASequence) {
  write("v.nrrd", "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 1 3 4\nencoding: raw\n\n" +
                      bytesOf(counting<uint8_t>(24)));
  const LoadedVolume volume = readPath(path("v.nrrd"));
  EXPECT_EQ(volume.dimension, 4);
  EXPECT_EQ(volume.frames, 4);
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 1, 3}));
  EXPECT_EQ(volume.samples, counting<float>(24));
}

TEST_F(Nrrd, refusesNaN) {
  write("v.nrrd",
        "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: little\n\n" +
            bytesOf(std::vector<float>{1, std::numeric_limits<float>::quiet_NaN()}));
  EXPECT_NE(complaint(path("v.nrrd")).find("the first at (1, 0, 0)"), std::string::npos)
      << complaint(path("v.nrrd"));
}

TEST_F(Nrrd, refusesImpossibleSizes) {
  write("v.nrrd",
        "NRRD0004\ntype: float\ndimension: 3\nsizes: 100000 100000 100000\nencoding: gzip\nendian: "
        "little\n\n1234");
  EXPECT_NE(complaint(path("v.nrrd")).find("cannot hold"), std::string::npos)
      << complaint(path("v.nrrd"));
}

TEST_F(Nrrd, refusesEveryCutAndForeignFile) {
  const std::string whole = read(std::filesystem::path(shorts("")).filename());
  for (size_t length = 0; length < whole.size(); ++length) {
    const std::string found = complaint(write("cut.nrrd", whole.substr(0, length)));
    EXPECT_NE(found, "") << "cut at " << length;
    EXPECT_EQ(found.find('\n'), std::string::npos);
  }
  EXPECT_NE(complaint(write("v.nrrd", "<!DOCTYPE html>")), "");
}

TEST_F(Nrrd, refusesEveryCutOfGzip) {
  const std::string head =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 20 20 20\nencoding: gzip\n\n";
  const std::string packed = gzip(bytesOf(counting<uint8_t>(8000)));
  // The checksum behind the last sample may be missing; a sample may not.
  for (size_t length = 0; length + 20 < packed.size(); length += 3)
    EXPECT_NE(complaint(write("cut.nrrd", head + packed.substr(0, length))), "")
        << "cut at " << length;
}

}  // namespace
}  // namespace isostar::native
