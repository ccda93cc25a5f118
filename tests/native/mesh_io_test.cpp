#include <cstring>
#include <nlohmann/json.hpp>

#include "byte_string.h"
#include "files/failure.h"
#include "mesh_io/mesh_file.h"
#include "scratch_folder.h"
#include "shapes.h"

namespace isostar::native {
namespace {

Mesh withNormals(Mesh mesh) {
  for (size_t v = 0; v < mesh.positions.size() / 3; ++v)
    mesh.normals.insert(mesh.normals.end(), {0, 0, 1});
  return mesh;
}

class MeshFile : public ScratchFolder {
 protected:
  Mesh roundTrip(const Mesh& mesh, const std::string& name) const {
    writeMesh(mesh, path(name));
    return readMesh(path(name));
  }

  std::string complaint(const std::string& name, const std::string& content) const {
    write(name, content);
    try {
      readMesh(path(name));
    } catch (const Failure& failure) {
      return failure.what();
    }
    return {};
  }
};

TEST_F(MeshFile, plyAndObjKeepEveryBit) {
  for (const Mesh& mesh : {torus(9, 3.1, 0.7), withNormals(torus(9, 3.1, 0.7)), Mesh{}}) {
    for (const char* name : {"mesh.ply", "mesh.obj", "mesh.glb"}) {
      const Mesh again = roundTrip(mesh, name);
      EXPECT_EQ(again.positions, mesh.positions) << name;
      EXPECT_EQ(again.indices, mesh.indices) << name;
    }
  }
}

TEST_F(MeshFile, stlWeldsCornersAtOnePlace) {
  const Mesh again = roundTrip(torus(9, 3.1, 0.7), "mesh.stl");
  EXPECT_EQ(again.positions.size(), 3 * 81u);
  EXPECT_EQ(again.indices.size(), 3 * 162u);
  EXPECT_TRUE(roundTrip({}, "empty.stl").positions.empty());
}

TEST_F(MeshFile, glbIsWellFormed) {
  const Mesh mesh = withNormals(cube(1, 2, 3, 4));
  writeMesh(mesh, path("mesh.glb"));
  const std::string file = read("mesh.glb");
  uint32_t head[5];
  std::memcpy(head, file.data(), sizeof head);
  EXPECT_EQ(file.substr(0, 4), "glTF");
  EXPECT_EQ(head[1], 2u);
  EXPECT_EQ(head[2], file.size());
  const auto json = nlohmann::json::parse(file.substr(20, head[3]));
  const auto& accessors = json["accessors"];
  EXPECT_EQ(accessors[0]["min"], (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(accessors[0]["max"], (std::vector<float>{5, 6, 7}));
  EXPECT_EQ(accessors[json["meshes"][0]["primitives"][0]["indices"].get<size_t>()]["count"], 36);
  const size_t binary = 20 + head[3] + 8;
  EXPECT_EQ(file.substr(binary, 96), bytesOf(mesh.positions));
  EXPECT_EQ(json["buffers"][0]["byteLength"], file.size() - binary);
  EXPECT_EQ(binary % 4, 0u);
}

const std::string kPrimitive = R"({"attributes":{"POSITION":0},"indices":1})";

/// A GLB of one triangle with 16-bit indices behind its positions, in a scene of these nodes.
std::string glb(const std::string& nodes, const std::string& more = "",
                const std::string& primitives = kPrimitive) {
  std::string json =
      "{\"scenes\":[{\"nodes\":[0]}],\"nodes\":" + nodes + ",\"meshes\":[{\"primitives\":[" +
      primitives +
      "]}],"
      "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
      "{\"bufferView\":1,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
      "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"
      "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}]" +
      more + "}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string binary = bytesOf(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                             bytesOf(std::vector<uint16_t>{2, 1, 0, 0});
  const auto word = [](size_t value) { return bytesOf(static_cast<uint32_t>(value)); };
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" +
         json + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

TEST_F(MeshFile, glbNodesLieWhereTheSceneHasThem) {
  write(
      "a.glb",
      glb(R"([{"children":[1],"translation":[10,0,0]},{"mesh":0,"scale":[2,2,2],"rotation":[0,0,0.6,0.8]}])"));
  const Mesh mesh = readMesh(path("a.glb"));
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{2, 1, 0}));
  EXPECT_NEAR(mesh.positions[3], 10 + 2 * 0.28,
              1e-6);  // x is turned by twice the angle of cosine 0.8
  EXPECT_NEAR(mesh.positions[4], 2 * 0.96, 1e-6);
  write("b.glb", glb(R"([{"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,5,6,7,1]}])"));
  const Mesh turned = readMesh(path("b.glb"));
  EXPECT_EQ((std::vector<float>(turned.positions.begin() + 3, turned.positions.begin() + 6)),
            (std::vector<float>{5, 7, 7}));
}

TEST_F(MeshFile, refusesDamagedGlb) {
  EXPECT_NE(complaint("a.glb", glb(R"([{"children":[0],"mesh":0}])")).find("contains itself"),
            std::string::npos);
  EXPECT_NE(complaint("a.glb", glb(R"([{"children":[7]}])")).find("damaged"), std::string::npos);
  EXPECT_NE(complaint("a.glb", glb(R"([{"mesh":"x"}])")).find("damaged"), std::string::npos);
  EXPECT_NE(complaint("a.glb", glb(R"([{"mesh":0}])",
                                   R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"))
                .find("KHR_draco"),
            std::string::npos);
  const std::string whole = glb(R"([{"mesh":0}])");
  EXPECT_EQ(complaint("a.glb", whole), "");
  for (size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(complaint("a.glb", whole.substr(0, length)), "");
  for (size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 9);
    (void)complaint("a.glb", changed);  // a line or a mesh, no crash
  }
}

std::string repeated(const std::string& words, size_t count) {
  std::string all;
  for (size_t i = 0; i < count; ++i) all += (i ? "," : "") + words;
  return all;
}

TEST_F(MeshFile, refusesAGlbThatGrowsBeyondItsLength) {
  const std::string children =
      "[{\"children\":[" + repeated("0", 8000) + "]}," + repeated("{}", 6000) + "]";
  EXPECT_NE(complaint("a.glb", glb(children)).find("two parents"), std::string::npos);
  std::string nodes = "[{\"children\":[1";
  for (int i = 2; i <= 6000; ++i) nodes.append(",").append(std::to_string(i));
  nodes += "]}," + repeated("{\"mesh\":0}", 6000) + "]";
  EXPECT_EQ(complaint("a.glb", glb(nodes)), "");
  EXPECT_NE(complaint("a.glb", glb(nodes, "", repeated(kPrimitive, 1000)))
                .find("too many for its length"),
            std::string::npos);
}

TEST_F(MeshFile, glbOfNothingIsAnEmptyScene) {
  writeMesh({}, path("empty.glb"));
  const std::string file = read("empty.glb");
  const auto json = nlohmann::json::parse(file.substr(20));
  EXPECT_FALSE(json.contains("accessors"));
  EXPECT_FALSE(json.contains("meshes"));
}

TEST_F(MeshFile, readsTextPlyWithPolygonsAndOtherElements) {
  write("mesh.ply",
        "ply\r\nformat ascii 1.0\r\ncomment from elsewhere\r\nelement camera 1\r\nproperty list "
        "uchar float view\r\n"
        "element vertex 4\r\nproperty uchar red\r\nproperty double x\r\nproperty float "
        "y\r\nproperty float z\r\n"
        "element face 1\r\nproperty list uchar uint vertex_index\r\nend_header\r\n"
        "2 7.5 8\r\n255 0 0 0\r\n255 1 0 0\r\n255 1 1 0\r\n255 0 1.5e0 0\r\n4 0 1 2 3\r\n");
  const Mesh mesh = readMesh(path("mesh.ply"));
  EXPECT_EQ(mesh.positions, (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1.5, 0}));
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST_F(MeshFile, readsObjWithQuadsAndRelativeIndices) {
  write("mesh.obj",
        "# quad\nv 0 0 0\nv 1 0 0\nvt 0 0\nv 1 1 0\nv 0 1 0\nf 1/1/1 2//1 3 4/1\nf -4 -3 -2\n");
  EXPECT_EQ(readMesh(path("mesh.obj")).indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2}));
}

TEST_F(MeshFile, readsTextStl) {
  write("mesh.stl",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
        "0\nendloop\nendfacet\n"
        "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid a\n");
  const Mesh mesh = readMesh(path("mesh.stl"));
  EXPECT_EQ(mesh.positions.size(), 12u);
  EXPECT_EQ(mesh.indices.size(), 6u);
}

TEST_F(MeshFile, refusesWhatItCannotTrust) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(complaint("a.ply", head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").find("uses vertex 3 of 3"),
            std::string::npos);
  EXPECT_NE(complaint("a.ply", head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n").find("uses vertex -1"),
            std::string::npos);
  EXPECT_NE(complaint("a.ply", head + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n").find("not finite"),
            std::string::npos);
  EXPECT_NE(complaint("a.ply", head + "0 0 0\n1 0").find("ends early"), std::string::npos);
  EXPECT_NE(
      complaint(
          "a.ply",
          "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\nproperty float x\n"
          "property float y\nproperty float z\nend_header\n")
          .find("claims"),
      std::string::npos);
  EXPECT_NE(
      complaint("a.ply", "ply\nformat binary_big_endian 1.0\nend_header\n").find("big_endian"),
      std::string::npos);
  EXPECT_NE(complaint("a.ply", "hello").find("is not a PLY"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0\n").find("not have three coordinates"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 0\nf 1 2 3\n").find("uses vertex 1 of 1"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 0\nf 0 1 1\n").find("uses vertex 0"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "\x89PNG\n").find("is not an OBJ"), std::string::npos);
  EXPECT_NE(complaint("a.stl", "short").find("is not an STL"), std::string::npos);
}

TEST_F(MeshFile, everyPrefixOfAMeshIsReadOrRefused) {
  const Mesh mesh = withNormals(cube(0, 0, 0, 1));
  for (const char* name : {"mesh.ply", "mesh.stl", "mesh.obj"}) {
    writeMesh(mesh, path(name));
    const std::string whole = read(name);
    for (size_t length = 0; length < whole.size(); ++length)
      complaint(name, whole.substr(0, length));
  }
}

}  // namespace
}  // namespace isostar::native
