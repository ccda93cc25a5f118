#include <algorithm>
#include <cctype>
#include <fstream>

#include "files/child_process.h"
#include "files/input_file.h"
#include "files/text.h"
#include "tetrahedra/formats.h"
#include "tetrahedra/mend.h"

namespace isostar::native {
namespace {

/// The fourth line of a legacy file, or one soon after, tells what it holds.
bool holdsUnstructuredGrid(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(2048, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(file.gcount()));
  std::transform(head.begin(), head.end(), head.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  return head.find("UNSTRUCTURED_GRID") != std::string::npos;
}

}  // namespace

bool isTetrahedral(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == ".vtu" || (extension == ".vtk" && holdsUnstructuredGrid(path));
}

TetrahedralMesh readTetrahedra(const std::string& path, const std::optional<std::string>& scalar) {
  fileSize(path);
  Handover handover(path);
  runInChild(handover, [&](Handover& to) {
    TetrahedralMesh mesh = readVtkTetrahedra(path, scalar);
    mend(mesh, path);
    to.put(mesh.points);
    to.put(mesh.values);
    to.put(mesh.tetrahedra);
    to.put(mesh.remarks);
  });
  TetrahedralMesh mesh;
  handover.take(mesh.points);
  handover.take(mesh.values);
  handover.take(mesh.tetrahedra);
  handover.take(mesh.remarks);
  return mesh;
}

}  // namespace isostar::native
