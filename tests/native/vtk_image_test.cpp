#include "byte_string.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

std::string countingWords(int count) {
  std::string words;
  for (int i = 0; i < count; ++i) words += std::to_string(i) + " ";
  return words;
}

std::string vti(const std::string& components = "1", const std::string& head = "") {
  return "<?xml version=\"1.0\"?>\n" + head +
         "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
         "<ImageData WholeExtent=\"1 2 0 2 0 3\" Origin=\"10 20 30\" Spacing=\"0.5 2 3\" "
         "Direction=\"0 -1 0 1 0 0 0 0 "
         "1\">\n"
         "<Piece Extent=\"1 2 0 2 0 3\"><PointData Scalars=\"s\"><DataArray type=\"Int16\" "
         "Name=\"s\" format=\"ascii\" "
         "NumberOfComponents=\"" +
         components + "\">" + countingWords(24 * std::stoi(components)) +
         "</DataArray></PointData></Piece></ImageData></VTKFile>\n";
}

std::string legacy() {
  return "# vtk DataFile Version 3.0\ncounting\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 3 "
         "4\nORIGIN 1 2 3\n"
         "SPACING 0.5 2 3\nPOINT_DATA 24\nSCALARS s float 1\nLOOKUP_TABLE default\n" +
         countingWords(24) + "\n";
}

using VtkImage = ScratchFolder;

TEST_F(VtkImage, readsVtiWithExtentAndDirection) {
  const LoadedVolume volume = readPath(write("v.vti", vti()));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  expectCounting(volume.samples);
  // The extent begins at 1: the first sample is a step along the first axis, which points along y.
  expectPoint(worldOf(volume.placement, 0, 0, 0), 10, 20.5, 30);
  expectPoint(worldOf(volume.placement, 0, 1, 1), 8, 20.5, 33);
}

TEST_F(VtkImage, readsLegacyStructuredPoints) {
  const LoadedVolume volume = readPath(write("v.vtk", legacy()));
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{2, 3, 4}));
  expectCounting(volume.samples);
  expectPoint(worldOf(volume.placement, 1, 1, 1), 1.5, 4, 6);
}

TEST_F(VtkImage, refusesVectorsEntitiesAndForeignFiles) {
  EXPECT_NE(complaint(write("v.vti", vti("3"))).find("3 values per sample"), std::string::npos);
  EXPECT_NE(complaint(write("v.vti", vti("1", "<!DOCTYPE a [<!ENTITY b \"c\">]>"))).find("DOCTYPE"),
            std::string::npos);
  EXPECT_NE(complaint(write("v.vti", "hello")), "");
  EXPECT_NE(complaint(write("v.vtk", "hello")), "");
}

TEST_F(VtkImage, refusesCutFiles) {
  for (const auto& [name, whole] : {std::pair{"v.vti", vti()}, std::pair{"v.vtk", legacy()}}) {
    for (size_t length = 0; length + 10 < whole.size(); length += 11)
      EXPECT_NE(complaint(write(name, whole.substr(0, length))), "")
          << name << " cut at " << length;
  }
}

}  // namespace
}  // namespace isostar::native
