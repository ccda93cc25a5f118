#include "mesh_io/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "mesh_io/mesh_formats.h"

namespace isostar::native {
namespace {

struct Format {
  void (*write)(const Mesh&, OutputFile&);
  Mesh (*read)(std::span<const std::byte>, const std::string&);
  bool hasNormals = true;  // of vertices
};

const Format* formatOf(const std::string& path) {
  static const std::map<std::string, Format> kFormats = {{".ply", {writePly, readPly}},
                                                         {".obj", {writeObj, readObj}},
                                                         {".stl", {writeStl, readStl, false}},
                                                         {".glb", {writeGlb, readGlb}}};
  const auto found = kFormats.find(extensionOf(path));
  return found == kFormats.end() ? nullptr : &found->second;
}

void requireValid(const Mesh& mesh, const std::string& path) {
  const size_t vertices = mesh.positions.size() / 3;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!std::isfinite(mesh.positions[i]))
      throw Failure(path, text("vertex %zu is not finite", i / 3));
  }
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    if (mesh.indices[i] >= vertices)
      throw Failure(path,
                    text("triangle %zu uses vertex %u of %zu", i / 3, mesh.indices[i], vertices));
  }
}

}  // namespace

bool isMeshFile(const std::string& path) {
  return formatOf(path) != nullptr;
}

bool storesNormals(const std::string& path) {
  return formatOf(path)->hasNormals;
}

void writeMesh(const Mesh& mesh, const std::string& path) {
  OutputFile file(path);
  formatOf(path)->write(mesh, file);
  file.commit();
}

Mesh readMesh(const std::string& path) {
  const std::vector<std::byte> bytes = readFile(path);
  Mesh mesh = formatOf(path)->read(bytes, path);
  requireValid(mesh, path);
  return mesh;
}

}  // namespace isostar::native
