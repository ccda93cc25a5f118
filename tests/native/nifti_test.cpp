#include <cstring>
#include <limits>

#include "byte_string.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

/// NIfTI-1's header, the fields that the tests set.
struct Header {
  std::string bytes = std::string(352, '\0');

  template <class Value>
  Header& put(size_t at, const Value& value) {
    std::memcpy(&bytes[at], &value, sizeof value);
    return *this;
  }

  Header() {
    put<int32_t>(0, 348).size(3, 2, 3, 4).type(4, 16).put<float>(108, 352).pixdim(1, 1, 1);
    std::memcpy(&bytes[344], "n+1", 4);
  }
  Header& size(int16_t dimensions, int16_t x, int16_t y, int16_t z, int16_t t = 1) {
    return put(40, std::array<int16_t, 8>{dimensions, x, y, z, t, 1, 1, 1});
  }
  Header& type(int16_t code, int16_t bits) { return put(70, code).put(72, bits); }
  Header& pixdim(float x, float y, float z) { return put(76, std::array<float, 4>{1, x, y, z}); }
  Header& scale(float slope, float intercept) { return put(112, slope).put(116, intercept); }
  Header& sform(const std::array<float, 12>& rows) { return put<int16_t>(254, 1).put(280, rows); }
};

class Nifti : public ScratchFolder {
 protected:
  LoadedVolume readShorts(const Header& header) const {
    return readPath(write("v.nii", header.bytes + bytesOf(counting<int16_t>(24))));
  }
};

TEST_F(Nifti, readsSamplesAndTurnsRasIntoLps) {
  const LoadedVolume volume = readShorts(Header().sform({2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30}));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  expectCounting(volume.samples);
  expectPoint(worldOf(volume.placement, 0, 0, 0), -10, -20, 30);
  expectPoint(worldOf(volume.placement, 1, 1, 1), -12, -23, 34);
  EXPECT_TRUE(volume.remarks.empty());
}

TEST_F(Nifti, keepsAShearedAffine) {
  // 30 degrees off: ITK 5.2 refuses the file.
  const LoadedVolume volume =
      readShorts(Header().sform({1, 0.5f, 0, 1, 0, 0.8660254f, 0, 2, 0, 0, 2, 3}));
  expectPoint(worldOf(volume.placement, 0, 0, 0), -1, -2, 3);
  expectPoint(worldOf(volume.placement, 1, 2, 3), -3, -2 - 2 * 0.8660254, 9);
  ASSERT_EQ(volume.remarks.size(), 1u);
  EXPECT_NE(volume.remarks[0].find("30 degrees"), std::string::npos) << volume.remarks[0];
}

TEST_F(Nifti, prefersSformThenQformThenSpacing) {
  Header header;
  header.pixdim(2, 3, 4);
  expectPoint(worldOf(readShorts(header).placement, 1, 1, 1), -2, -3, 4);
  header.put<int16_t>(252, 1).put(268, std::array<float, 3>{7, 8, 9});
  expectPoint(worldOf(readShorts(header).placement, 1, 1, 1), -9, -11, 13);
  header.sform({5, 0, 0, 0, 0, 5, 0, 0, 0, 0, 5, 0});
  expectPoint(worldOf(readShorts(header).placement, 1, 1, 1), -5, -5, 5);
}

TEST_F(Nifti, turnsMetresIntoMillimetres) {
  const LoadedVolume volume =
      readShorts(Header().sform({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}).put<uint8_t>(123, 1));
  expectPoint(worldOf(volume.placement, 1, 1, 1), -1000, -1000, 1000);
}

TEST_F(Nifti, appliesItsSlope) {
  const LoadedVolume volume = readShorts(Header().scale(2, -1000));
  EXPECT_EQ(volume.samples[3], -994);
  EXPECT_EQ(readShorts(Header().scale(0, 5)).samples[3], 3);
}

TEST_F(Nifti, refusesNaN) {
  std::vector<float> samples = counting<float>(24);
  samples[7] = std::numeric_limits<float>::quiet_NaN();
  const std::string found =
      complaint(write("v.nii", Header().type(16, 32).bytes + bytesOf(samples)));
  EXPECT_NE(found.find("the first at (1, 0, 1)"), std::string::npos) << found;
}

TEST_F(Nifti, readsASeriesAsASequence) {
  const LoadedVolume volume =
      readPath(write("v.nii", Header().size(4, 2, 3, 4, 2).bytes + bytesOf(counting<int16_t>(48))));
  EXPECT_EQ(volume.dimension, 4);
  EXPECT_EQ(volume.frames, 2);
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  EXPECT_EQ(volume.samples, counting<float>(48));
}

TEST_F(Nifti, refusesColoursAndFlatAffines) {
  const std::string samples = bytesOf(counting<int16_t>(48));
  EXPECT_NE(complaint(write("v.nii", Header().type(128, 24).bytes + samples)).find("RGB"),
            std::string::npos);
  EXPECT_NE(complaint(write("v.nii",
                            Header().sform({1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0}).bytes + samples))
                .find("inverted"),
            std::string::npos);
}

TEST_F(Nifti, refusesEveryCutFile) {
  const std::string whole = Header().bytes + bytesOf(counting<int16_t>(24));
  for (size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(complaint(write("v.nii", whole.substr(0, length))), "") << "cut at " << length;
}

TEST_F(Nifti, refusesImpossibleSizes) {
  EXPECT_NE(complaint(write("v.nii", Header().size(3, 32767, 32767, 32767).bytes + "1234"))
                .find("cannot hold"),
            std::string::npos);
}

}  // namespace
}  // namespace isostar::native
