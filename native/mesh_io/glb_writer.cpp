#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "files/failure.h"
#include "mesh_io/glb_format.h"
#include "mesh_io/mesh_formats.h"

namespace isostar::native {
namespace {

using Json = nlohmann::ordered_json;
using namespace glb;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

/// The JSON of a scene, and the binary chunk that it describes as a list of borrowed pieces.
class Scene {
 public:
  explicit Scene(const Mesh& mesh) {
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "isostar"}}}, {"scene", 0}};
    // glTF does not allow an empty accessor: an empty surface is a scene without nodes.
    if (mesh.indices.empty()) {
      json_["scenes"] = Json::array({Json::object()});
      return;
    }
    json_["scenes"] = Json::array({{{"nodes", {0}}}});
    json_["nodes"] = Json::array({{{"mesh", 0}}});
    Json primitive{{"attributes", {{"POSITION", addVectors(mesh.positions)}}}, {"material", 0}};
    if (!mesh.normals.empty()) primitive["attributes"]["NORMAL"] = addVectors(mesh.normals);
    primitive["indices"] =
        add(mesh.indices.data(), mesh.indices.size() * 4, kElementArrayBuffer,
            {{"componentType", kUnsignedInt}, {"count", mesh.indices.size()}, {"type", "SCALAR"}});
    json_["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
    // A surface that leaves the box is open there and shows its inside.
    json_["materials"] =
        Json::array({{{"doubleSided", true}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}}});
    json_["buffers"] = Json::array({{{"byteLength", length_}}});
  }

  void write(OutputFile& file) const {
    std::string json = json_.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const uint64_t total = 12 + 8 + json.size() + (length_ > 0 ? 8 + length_ : 0);
    if (total > UINT32_MAX)
      throw Failure(file.target(), "the surface is too large for GLB, which is limited to 4 GB");
    writeWords(file, {kMagic, kVersion, static_cast<uint32_t>(total)});
    writeWords(file, {static_cast<uint32_t>(json.size()), kJsonChunk});
    file.write(json.data(), json.size());
    if (length_ == 0) return;
    writeWords(file, {static_cast<uint32_t>(length_), kBinaryChunk});
    for (const auto& [bytes, count] : pieces_) file.write(bytes, count);
  }

 private:
  static void writeWords(OutputFile& file, std::initializer_list<uint32_t> words) {
    for (uint32_t word : words) file.write(&word, 4);
  }

  size_t add(const void* bytes, size_t count, int target, Json accessor) {
    const size_t index = pieces_.size();
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", length_}, {"byteLength", count}, {"target", target}});
    accessor["bufferView"] = index;
    json_["accessors"].push_back(std::move(accessor));
    pieces_.push_back({bytes, count});
    length_ += count;
    return index;
  }

  size_t addVectors(const std::vector<float>& numbers) {
    std::array<float, 3> low, high;
    std::copy_n(numbers.begin(), 3, low.begin());
    high = low;
    for (size_t i = 0; i < numbers.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], numbers[i]);
      high[i % 3] = std::max(high[i % 3], numbers[i]);
    }
    return add(numbers.data(), numbers.size() * 4, kArrayBuffer,
               {{"componentType", kFloat},
                {"count", numbers.size() / 3},
                {"type", "VEC3"},
                {"min", low},
                {"max", high}});
  }

  Json json_;
  std::vector<std::pair<const void*, size_t>> pieces_;
  uint64_t length_ = 0;
};

}  // namespace

void writeGlb(const Mesh& mesh, OutputFile& file) {
  Scene(mesh).write(file);
}

}  // namespace isostar::native
