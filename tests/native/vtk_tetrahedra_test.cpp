// Unstructured grids as VTK's readers meet them; what is wrong is said in one line.
#include <gtest/gtest.h>

#include "files/failure.h"
#include "files/sanitizers.h"
#include "scratch_folder.h"
#include "tetrahedra/tetrahedra_reader.h"

namespace isostar::native {
namespace {

/// Two tetrahedra on five points, and what a test wants to be different.
struct Parts {
  std::string points = "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1";
  std::string cells = "0 1 2 3 1 2 3 4", offsets = "4 8", types = "10 10";
  std::string arrays = R"(<DataArray type="Float32" Name="t" format="ascii">1 2 3 4 5</DataArray>)";
  std::string marked = "";
};

std::string vtu(const Parts& parts = {}, const std::string& head = "") {
  const auto array = [](const std::string& attributes, const std::string& values) {
    return "<DataArray format=\"ascii\" " + attributes + ">" + values + "</DataArray>";
  };
  return "<?xml version=\"1.0\"?>\n" + head +
         "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
         "<Piece NumberOfPoints=\"5\" NumberOfCells=\"" +
         std::to_string(1 + std::count(parts.types.begin(), parts.types.end(), ' ')) +
         "\"><PointData" + parts.marked + ">" + parts.arrays + "</PointData><Points>" +
         array("type=\"Float64\" NumberOfComponents=\"3\"", parts.points) + "</Points><Cells>" +
         array("type=\"Int64\" Name=\"connectivity\"", parts.cells) +
         array("type=\"Int64\" Name=\"offsets\"", parts.offsets) +
         array("type=\"UInt8\" Name=\"types\"", parts.types) +
         "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

std::string legacy() {
  return "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n"
         "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\nCELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\nCELL_TYPES 2\n10\n10\n"
         "POINT_DATA 5\nVECTORS v float\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
         "SCALARS p float 1\nLOOKUP_TABLE default\n9 8 7 6 5\nSCALARS t float 1\nLOOKUP_TABLE "
         "default\n1 2 3 4 5\n";
}

class VtkTetrahedra : public ScratchFolder {
 protected:
  std::string complaint(const std::string& name, const std::string& content,
                        const std::optional<std::string>& scalar = {}) const {
    try {
      readTetrahedra(write(name, content), scalar);
    } catch (const Failure& failure) {
      const std::string words = failure.what();
      EXPECT_EQ(words.find('\n'), std::string::npos);
      return words.substr(words.find(name) + name.size());
    }
    return {};
  }
};

/// VTK allocates for the 2^30 blocks that the array claims before it reads one.
TEST_F(VtkTetrahedra, saysThatBlocksAreTooMany) {
  if (kReservesAddresses) GTEST_SKIP() << "the limit of memory is not set";
  std::string file = vtu();
  const std::string cells = "<DataArray format=\"ascii\" type=\"Int64\" Name=\"connectivity\">";
  const size_t at = file.find(cells);
  ASSERT_NE(at, std::string::npos);
  const size_t end = file.find('<', at + cells.size());
  file.replace(
      at, end - at,
      "<DataArray format=\"binary\" type=\"Int64\" Name=\"connectivity\">AAAAQACAAAAAAAAA");
  file.insert(file.find(" byte_order"), " compressor=\"vtkZLibDataCompressor\"");
  EXPECT_NE(complaint("a.vtu", file).find("reading takes more than 1.0"), std::string::npos)
      << complaint("a.vtu", file);
}

TEST_F(VtkTetrahedra, readsBothFormats) {
  for (const auto& [name, content] : {std::pair{"a.vtu", vtu()}, std::pair{"a.vtk", legacy()}}) {
    const std::string path = write(name, content);
    EXPECT_TRUE(isTetrahedral(path));
    const TetrahedralMesh mesh = readTetrahedra(path, "t");
    EXPECT_EQ(mesh.points.size(), 5u);
    EXPECT_EQ(mesh.points[4].z, 1);
    EXPECT_EQ(mesh.values, (std::vector<float>{1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh.tetrahedra.size(), 2u);
  }
  EXPECT_FALSE(isTetrahedral(
      write("image.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_POINTS\n")));
}

TEST_F(VtkTetrahedra, takesTheMarkedScalarElseTheFirst) {
  Parts parts;
  parts.arrays += R"(<DataArray type="Int32" Name="s" format="ascii">9 8 7 6 5</DataArray>)";
  EXPECT_EQ(readTetrahedra(write("a.vtu", vtu(parts)), {}).values[0], 1);
  EXPECT_EQ(readTetrahedra(write("a.vtu", vtu(parts)), "s").values[0], 9);
  parts.marked = " Scalars=\"s\"";
  EXPECT_EQ(readTetrahedra(write("a.vtu", vtu(parts)), {}).values[0], 9);
  EXPECT_EQ(readTetrahedra(write("a.vtk", legacy()), "p").values[0], 9);
}

TEST_F(VtkTetrahedra, tellsWhichScalarsThereAre) {
  EXPECT_EQ(complaint("a.vtu", vtu(), "u"), ": has no scalar u at its points, but t");
  EXPECT_EQ(complaint("a.vtk", legacy(), "v"),
            ": v has 3 values per point; one is needed, as in p, t");
  Parts parts;
  parts.arrays =
      R"(<DataArray type="Float32" Name="v" NumberOfComponents="2" format="ascii">1 2 3 4 5 6 7 8 9 0</DataArray>)";
  EXPECT_EQ(complaint("a.vtu", vtu(parts)), ": has no scalars at its points, only vectors: v");
  parts.arrays = "";
  EXPECT_EQ(complaint("a.vtu", vtu(parts)), ": has no scalars at its points");
}

TEST_F(VtkTetrahedra, countsOtherCells) {
  Parts parts;
  parts.types = "10 5";
  parts.offsets = "4 7";
  EXPECT_EQ(readTetrahedra(write("a.vtu", vtu(parts)), {}).remarks,
            (std::vector<std::string>{"cells that are not tetrahedra, left out: 1",
                                      "points of no tetrahedron, left out: 1"}));
  parts.types = "5 5";
  parts.offsets = "3 6";
  EXPECT_EQ(complaint("a.vtu", vtu(parts)), ": has no tetrahedra (cells of other types: 2)");
}

TEST_F(VtkTetrahedra, refusesNumbersThatAreNone) {
  Parts parts;
  parts.arrays = R"(<DataArray type="Float32" Name="t" format="ascii">1 nan 3 4 5</DataArray>)";
  EXPECT_EQ(complaint("a.vtu", vtu(parts)), ": not finite: 1 of 5 scalars, the first at point 1");
  std::string text = legacy();
  text.replace(text.find("1 2 3 4 5\n", text.find(" t float")), 1, "nan");
  EXPECT_EQ(complaint("a.vtk", text), ": has a number that is not finite: nan");
  parts = {};
  parts.cells = "0 1 2 3 1 2 3 40";
  EXPECT_EQ(complaint("a.vtu", vtu(parts)), ": cell 1 uses point 40 of 5");
  parts.cells = "0 1 2 3 1 2 3 -4";
  EXPECT_NE(complaint("a.vtu", vtu(parts)), "");
}

TEST_F(VtkTetrahedra, refusesEntitiesForeignAndCutFiles) {
  EXPECT_NE(complaint("a.vtu", vtu({}, "<!DOCTYPE a [<!ENTITY b \"c\">]>")).find("DOCTYPE"),
            std::string::npos);
  EXPECT_NE(complaint("a.vtu", "hello"), "");
  EXPECT_NE(complaint("a.vtu", ""), "");
  for (const auto& [name, whole] : {std::pair{"a.vtu", vtu()}, std::pair{"a.vtk", legacy()}}) {
    for (size_t length = 0; length + 14 < whole.size(); length += 17)
      EXPECT_NE(complaint(name, whole.substr(0, length), "t"), "") << name << " cut at " << length;
  }
}

}  // namespace
}  // namespace isostar::native
