#include <algorithm>
#include <cctype>
#include <fstream>

#include "files/child_process.h"
#include "files/input_file.h"
#include "files/text.h"
#include "tetrahedra/mesh_repair.h"
#include "tetrahedra/tetrahedra_reader.h"

namespace isostar::native {
namespace {

/// The kind of data is on the fourth line of a legacy file or shortly after.
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
  const uint64_t bytes = fileSize(path);
  const auto read = [&] {
    TetrahedralMesh mesh = readVtkTetrahedra(path, scalar);
    repair(mesh, path);
    return mesh;
  };
  using M = TetrahedralMesh;
  return readInChild(path, limitsFor(bytes), read, &M::points, &M::values, &M::tetrahedra,
                     &M::remarks);
}

}  // namespace isostar::native
