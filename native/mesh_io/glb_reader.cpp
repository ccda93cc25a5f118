#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "files/failure.h"
#include "files/text.h"
#include "mesh_io/formats.h"

namespace isostar::native {
namespace {

using Json = nlohmann::json;
using Matrix = std::array<double, 16>;  // column-major, as glTF has it

constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kTriangles = 4, kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;
constexpr uint64_t kMostVertices = 1ull << 28;  // nodes may name one mesh again and again
constexpr Matrix kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (size_t column = 0; column < 4; ++column)
    for (size_t row = 0; row < 4; ++row)
      for (size_t i = 0; i < 4; ++i) c[4 * column + row] += a[4 * i + row] * b[4 * column + i];
  return c;
}

/// A node's own transformation: a matrix, or translation, rotation (a quaternion x, y, z, w) and
/// scale.
Matrix transformOf(const Json& node) {
  if (node.contains("matrix")) return node.at("matrix").get<Matrix>();
  const auto t = node.value("translation", std::array<double, 3>{0, 0, 0});
  const auto [x, y, z, w] = node.value("rotation", std::array<double, 4>{0, 0, 0, 1});
  const auto s = node.value("scale", std::array<double, 3>{1, 1, 1});
  return {(1 - 2 * (y * y + z * z)) * s[0],
          2 * (x * y + z * w) * s[0],
          2 * (x * z - y * w) * s[0],
          0,
          2 * (x * y - z * w) * s[1],
          (1 - 2 * (x * x + z * z)) * s[1],
          2 * (y * z + x * w) * s[1],
          0,
          2 * (x * z + y * w) * s[2],
          2 * (y * z - x * w) * s[2],
          (1 - 2 * (x * x + y * y)) * s[2],
          0,
          t[0],
          t[1],
          t[2],
          1};
}

/// The triangles of a scene's nodes, each where its node puts it.
class SceneReader {
 public:
  SceneReader(std::span<const std::byte> file, const std::string& path) : path_(path) {
    std::array<uint32_t, 3> head{};
    if (!copy(file, 0, head) || head[0] != kMagic) fail("is no GLB file");
    if (head[1] != 2) fail(text("is of GLB version %u; 2 is read", head[1]));
    std::string_view words;
    for (size_t at = 12; at < file.size();) {
      std::array<uint32_t, 2> chunk{};
      if (!copy(file, at, chunk) || chunk[0] > file.size() - at - 8) fail("is cut short");
      const auto bytes = file.subspan(at + 8, chunk[0]);
      if (chunk[1] == kJsonChunk)
        words = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
      if (chunk[1] == kBinaryChunk) binary_ = bytes;
      at += 8 + size_t{chunk[0]};
    }
    json_ = Json::parse(words);
  }

  Mesh read() {
    if (json_.contains("extensionsRequired")) {
      for (const Json& each : json_.at("extensionsRequired")) {
        const auto name = each.get<std::string>();
        if (name.find("compression") != std::string::npos)
          fail("is compressed by " + name + ", which is not read");
      }
    }
    const Json scenes = json_.value("scenes", Json::array());
    if (scenes.empty()) return {};
    for (const Json& node : scenes.at(json_.value("scene", 0)).value("nodes", Json::array()))
      waiting_.push_back({node.get<size_t>(), kIdentity});
    for (size_t visited = 0; !waiting_.empty(); ++visited) {
      if (visited == json_.at("nodes").size())
        fail("is damaged: a node is part of itself, or of two others");
      const auto [index, above] = waiting_.back();
      waiting_.pop_back();
      visit(json_.at("nodes").at(index), above);
    }
    return std::move(mesh_);
  }

 private:
  struct Accessor {
    size_t offset = 0, stride = 0, count = 0;
    int type = 0;
  };

  [[noreturn]] void fail(const std::string& what) const { throw Failure(path_, what); }

  template <class Words>
  static bool copy(std::span<const std::byte> from, size_t at, Words& words) {
    if (at > from.size() || from.size() - at < sizeof words) return false;
    std::memcpy(words.data(), from.data() + at, sizeof words);
    return true;
  }

  void visit(const Json& node, const Matrix& above) {
    const Matrix placement = product(above, transformOf(node));
    for (const Json& child : node.value("children", Json::array()))
      waiting_.push_back({child.get<size_t>(), placement});
    if (!node.contains("mesh")) return;
    for (const Json& primitive :
         json_.at("meshes").at(node.at("mesh").get<size_t>()).at("primitives")) {
      if (primitive.value("mode", kTriangles) == kTriangles) add(primitive, placement);
    }
  }

  /// An accessor whose bytes are all there.
  Accessor accessor(size_t index, const char* shape, size_t width) const {
    const Json& json = json_.at("accessors").at(index);
    if (json.contains("sparse") || !json.contains("bufferView"))
      fail("has a sparse accessor, which is not read");
    const Json& view = json_.at("bufferViews").at(json.at("bufferView").get<size_t>());
    const auto start = view.value("byteOffset", size_t{0}),
               length = view.at("byteLength").get<size_t>();
    Accessor found{json.value("byteOffset", size_t{0}), view.value("byteStride", size_t{0}),
                   json.at("count").get<size_t>(), json.at("componentType").get<int>()};
    const size_t each = width * (found.type == kByte ? 1 : found.type == kShort ? 2 : 4);
    if (found.stride == 0) found.stride = each;
    const bool fits =
        view.value("buffer", 0) == 0 && start <= binary_.size() &&
        length <= binary_.size() - start && found.offset <= length && found.stride >= each &&
        (found.count == 0 || (length - found.offset >= each &&
                              (length - found.offset - each) / found.stride >= found.count - 1));
    if (json.at("type") != shape || !fits) fail(text("is damaged: accessor %zu", index));
    found.offset += start;
    return found;
  }

  void add(const Json& primitive, const Matrix& m) {
    const Accessor places =
        accessor(primitive.at("attributes").at("POSITION").get<size_t>(), "VEC3", 3);
    if (places.type != kFloat) fail("has positions that are no floats, which are not read");
    const size_t first = mesh_.positions.size() / 3;
    if (first + places.count > kMostVertices) fail("has too many vertices");
    for (size_t v = 0; v < places.count; ++v) {
      std::array<float, 3> p{};
      copy(binary_, places.offset + v * places.stride, p);
      for (size_t row = 0; row < 3; ++row)
        mesh_.positions.push_back(static_cast<float>(m[row] * p[0] + m[4 + row] * p[1] +
                                                     m[8 + row] * p[2] + m[12 + row]));
    }
    if (!primitive.contains("indices")) {
      for (size_t v = 0; v < places.count / 3 * 3; ++v)
        mesh_.indices.push_back(static_cast<uint32_t>(first + v));
      return;
    }
    const Accessor indices = accessor(primitive.at("indices").get<size_t>(), "SCALAR", 1);
    if (indices.type != kByte && indices.type != kShort && indices.type != kInt)
      fail("has indices of an unknown type");
    if (mesh_.indices.size() + indices.count > 6 * kMostVertices) fail("has too many triangles");
    for (size_t i = 0; i < indices.count / 3 * 3; ++i) {
      uint32_t vertex = 0;
      std::memcpy(&vertex, binary_.data() + indices.offset + i * indices.stride,
                  indices.type == kByte    ? 1
                  : indices.type == kShort ? 2
                                           : 4);
      if (vertex >= places.count)
        fail(text("triangle %zu uses vertex %u of %zu", i / 3, vertex, places.count));
      mesh_.indices.push_back(static_cast<uint32_t>(first + vertex));
    }
  }

  const std::string& path_;
  Json json_;
  std::span<const std::byte> binary_;
  std::vector<std::pair<size_t, Matrix>> waiting_;
  Mesh mesh_;
};

}  // namespace

Mesh readGlb(std::span<const std::byte> bytes, const std::string& path) {
  try {
    return SceneReader(bytes, path).read();
  } catch (const Json::exception&) {
    throw Failure(path, "is no GLB file, or it is damaged");
  }
}

}  // namespace isostar::native
