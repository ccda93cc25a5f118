#include <limits>

#include "byte_string.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

class Raw : public ScratchFolder {
 protected:
  template <class Sample>
  void expectRead(SampleType type) const {
    write("v.raw", bytesOf(counting<Sample>(24)));
    const LoadedVolume volume = readVolume({path("v.raw"), ClaimedSize{2, 3, 4}, type, {}});
    EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
    EXPECT_EQ(volume.samples.size(), 24u);
    expectCounting(volume.samples);
  }
};

TEST_F(Raw, readsEveryType) {
  expectRead<uint8_t>(SampleType::U8);
  expectRead<int8_t>(SampleType::I8);
  expectRead<uint16_t>(SampleType::U16);
  expectRead<int16_t>(SampleType::I16);
  expectRead<float>(SampleType::F32);
  expectRead<double>(SampleType::F64);
}

TEST_F(Raw, takesSpacingFromTheCommandLine) {
  write("v.raw", bytesOf(counting<uint8_t>(8)));
  const LoadedVolume volume =
      readVolume({path("v.raw"), ClaimedSize{2, 2, 2}, SampleType::U8, {{0.5, 1, 2}}});
  expectPoint(worldOf(volume.placement, 1, 1, 1), 0.5, 1, 2);
}

TEST_F(Raw, refusesAnotherLength) {
  write("v.raw", "1234567");
  EXPECT_NE(
      complaint({path("v.raw"), ClaimedSize{2, 2, 2}, SampleType::U8, {}}).find("has 7 bytes"),
      std::string::npos);
}

TEST_F(Raw, refusesImpossibleSizesBeforeAllocating) {
  write("v.raw", "1234567");
  const int64_t large = int64_t{1} << 30;
  EXPECT_NE(complaint({path("v.raw"), ClaimedSize{large, large, large}, SampleType::F64, {}}), "");
  EXPECT_NE(complaint({path("v.raw"), ClaimedSize{int64_t{1} << 40, 1, 1}, SampleType::U8, {}})
                .find("impossible"),
            std::string::npos);
}

TEST_F(Raw, tellsWhereSamplesAreNotFinite) {
  std::vector<float> samples = counting<float>(24);
  samples[13] = std::numeric_limits<float>::quiet_NaN();
  samples[20] = std::numeric_limits<float>::infinity();
  write("v.raw", bytesOf(samples));
  const std::string found = complaint({path("v.raw"), ClaimedSize{2, 3, 4}, SampleType::F32, {}});
  EXPECT_NE(found.find("2 samples are not a finite number, the first at (1, 0, 2)"),
            std::string::npos)
      << found;
}

TEST_F(Raw, refusesNumbersBeyondFloats) {
  write("v.raw", bytesOf(std::vector<double>{0, 1e300}));
  EXPECT_NE(complaint({path("v.raw"), ClaimedSize{2, 1, 1}, SampleType::F64, {}}).find("(1, 0, 0)"),
            std::string::npos);
}

TEST_F(Raw, needsItsSizeAndType) {
  write("v.raw", "12345678");
  EXPECT_NE(complaint(path("v.raw")).find("--size and --type"), std::string::npos);
}

TEST_F(Raw, missingFileIsOneLine) {
  EXPECT_NE(complaint(path("none.nrrd")).find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace isostar::native
