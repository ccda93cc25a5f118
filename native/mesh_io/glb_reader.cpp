#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "files/failure.h"
#include "files/text.h"
#include "mesh_io/glb_format.h"
#include "mesh_io/mesh_formats.h"

namespace isostar::native {
namespace {

using Json = nlohmann::json;
using Matrix = std::array<double, 16>;  // column-major, as in glTF
using namespace glb;

constexpr int kTriangles = 4;
// Many nodes may refer to one mesh, so that a scene has more vertices than its file.
constexpr uint64_t kLeastVertices = 1ull << 21, kVerticesPerByte = 16, kMostVertices = 1ull << 28;
constexpr Matrix kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (size_t column = 0; column < 4; ++column)
    for (size_t row = 0; row < 4; ++row)
      for (size_t i = 0; i < 4; ++i) c[4 * column + row] += a[4 * i + row] * b[4 * column + i];
  return c;
}

/// A number that must be whole and not negative; JSON may write it with a fraction of zero. One
/// that is not is larger than anything that it could count.
size_t whole(const Json& json) {
  if (json.is_number_unsigned()) return json.get<size_t>();
  const auto number = json.get<double>();
  constexpr double kMost = 9007199254740992;  // beyond it not all whole numbers are doubles
  return number >= 0 && number <= kMost && number == std::floor(number)
             ? static_cast<size_t>(number)
             : SIZE_MAX;
}

size_t whole(const Json& object, const char* name, size_t otherwise) {
  return object.contains(name) ? whole(object.at(name)) : otherwise;
}

/// A node's local transformation: a matrix, or translation, rotation (a quaternion x, y, z, w) and
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

/// Collects the triangles of all nodes of a scene, transformed to the scene's coordinates.
class SceneReader {
 public:
  SceneReader(std::span<const std::byte> file, const std::string& path)
      : path_(path),
        most_(std::min(kLeastVertices + kVerticesPerByte * file.size(), kMostVertices)) {
    std::array<uint32_t, 3> head{};
    if (!copy(file, 0, head) || head[0] != kMagic) fail("is not a GLB file");
    if (head[1] != kVersion) fail(text("is of GLB version %u; only version 2 is read", head[1]));
    std::string_view description;
    for (size_t at = 12; at < file.size();) {
      std::array<uint32_t, 2> chunk{};
      if (!copy(file, at, chunk) || chunk[0] > file.size() - at - 8) fail("is cut short");
      const auto bytes = file.subspan(at + 8, chunk[0]);
      if (chunk[1] == kJsonChunk)
        description = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
      if (chunk[1] == kBinaryChunk) binary_ = bytes;
      at += 8 + size_t{chunk[0]};
    }
    json_ = Json::parse(description);
  }

  Mesh read() {
    if (json_.contains("extensionsRequired")) {
      for (const Json& each : json_.at("extensionsRequired")) {
        const auto name = each.get<std::string>();
        if (name.find("compression") != std::string::npos)
          fail("is compressed by " + name + ", which is not supported");
      }
    }
    const Json scenes = json_.value("scenes", Json::array());
    if (scenes.empty()) return {};
    for (const Json& node : scenes.at(whole(json_, "scene", 0)).value("nodes", Json::array()))
      await(node, kIdentity);
    while (!waiting_.empty()) {
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

  template <class Array>
  static bool copy(std::span<const std::byte> from, size_t at, Array& to) {
    if (at > from.size() || from.size() - at < sizeof to) return false;
    std::memcpy(to.data(), from.data() + at, sizeof to);
    return true;
  }

  static size_t bytesOf(int type) {
    return type == kUnsignedByte ? 1 : type == kUnsignedShort ? 2 : 4;
  }

  /// In a forest each node is awaited once.
  void await(const Json& node, const Matrix& above) {
    if (awaited_++ == json_.at("nodes").size())
      fail("is damaged: a node has two parents, or contains itself");
    waiting_.push_back({whole(node), above});
  }

  void visit(const Json& node, const Matrix& above) {
    const Matrix placement = product(above, transformOf(node));
    for (const Json& child : node.value("children", Json::array())) await(child, placement);
    if (!node.contains("mesh")) return;
    for (const Json& primitive : json_.at("meshes").at(whole(node.at("mesh"))).at("primitives")) {
      if (whole(primitive, "mode", kTriangles) == kTriangles) add(primitive, placement);
    }
  }

  /// An accessor, which is checked to lie within the binary chunk.
  Accessor accessor(size_t index, const char* shape, size_t width) const {
    const Json& json = json_.at("accessors").at(index);
    if (json.contains("sparse") || !json.contains("bufferView"))
      fail("has a sparse accessor, which is not supported");
    const Json& view = json_.at("bufferViews").at(whole(json.at("bufferView")));
    const auto start = whole(view, "byteOffset", 0), length = whole(view.at("byteLength"));
    Accessor found{
        .offset = whole(json, "byteOffset", 0),
        .stride = whole(view, "byteStride", 0),
        .count = whole(json.at("count")),
        .type = static_cast<int>(std::min<size_t>(whole(json.at("componentType")), INT_MAX))};
    const size_t each = width * bytesOf(found.type);
    if (found.stride == 0) found.stride = each;
    const bool fits =
        whole(view, "buffer", 0) == 0 && start <= binary_.size() &&
        length <= binary_.size() - start && found.offset <= length && found.stride >= each &&
        (found.count == 0 || (length - found.offset >= each &&
                              (length - found.offset - each) / found.stride >= found.count - 1));
    if (json.at("type") != shape || !fits) fail(text("is damaged: accessor %zu", index));
    found.offset += start;
    return found;
  }

  void add(const Json& primitive, const Matrix& placement) {
    const Accessor positions =
        accessor(whole(primitive.at("attributes").at("POSITION")), "VEC3", 3);
    if (positions.type != kFloat) fail("has positions that are not floats");
    const size_t first = mesh_.positions.size() / 3;
    addPositions(positions, placement);
    if (primitive.contains("indices"))
      return addIndices(accessor(whole(primitive.at("indices")), "SCALAR", 1), first,
                        positions.count);
    for (size_t v = 0; v < positions.count / 3 * 3; ++v)
      mesh_.indices.push_back(static_cast<uint32_t>(first + v));
  }

  void addPositions(const Accessor& positions, const Matrix& m) {
    used_ += 1 + positions.count;  // a primitive without vertices takes time too
    if (used_ > most_)
      fail(text("has more than %llu vertices, too many for its length",
                static_cast<unsigned long long>(most_)));
    for (size_t v = 0; v < positions.count; ++v) {
      std::array<float, 3> p{};
      copy(binary_, positions.offset + v * positions.stride, p);
      for (size_t row = 0; row < 3; ++row)
        mesh_.positions.push_back(static_cast<float>(m[row] * p[0] + m[4 + row] * p[1] +
                                                     m[8 + row] * p[2] + m[12 + row]));
    }
  }

  /// Triangles of the vertices from `first` on, of which there are `vertices`.
  void addIndices(const Accessor& indices, size_t first, size_t vertices) {
    if (indices.type != kUnsignedByte && indices.type != kUnsignedShort &&
        indices.type != kUnsignedInt)
      fail("has indices of an unknown type");
    if (mesh_.indices.size() + indices.count > 6 * most_)
      fail(text("has more than %llu triangles, too many for its length",
                static_cast<unsigned long long>(2 * most_)));
    for (size_t i = 0; i < indices.count / 3 * 3; ++i) {
      uint32_t vertex = 0;
      std::memcpy(&vertex, binary_.data() + indices.offset + i * indices.stride,
                  bytesOf(indices.type));
      if (vertex >= vertices)
        fail(text("triangle %zu uses vertex %u of %zu", i / 3, vertex, vertices));
      mesh_.indices.push_back(static_cast<uint32_t>(first + vertex));
    }
  }

  const std::string& path_;
  const uint64_t most_;  // vertices
  Json json_;
  std::span<const std::byte> binary_;
  std::vector<std::pair<size_t, Matrix>> waiting_;
  size_t awaited_ = 0, used_ = 0;
  Mesh mesh_;
};

}  // namespace

Mesh readGlb(std::span<const std::byte> bytes, const std::string& path) {
  try {
    return SceneReader(bytes, path).read();
  } catch (const Json::exception&) {
    throw Failure(path, "is not a GLB file, or it is damaged");
  }
}

}  // namespace isostar::native
