#include "bench/chunk_cost.h"

#include <algorithm>

#include "bench/chunks/chunk_bytes.h"
#include "bench/isostar_codec.h"

namespace isostar::bench {
namespace {

using Json = nlohmann::ordered_json;

/// The sum of the streams of a volume's cubes, which share their planes.
std::size_t croppedBytes(const Subject& subject, int side) {
  const auto& size = subject.volume.size;
  std::size_t sum = 0;
  std::array<int, 3> first{};
  for (first[2] = 0; first[2] + 1 < size[2]; first[2] += side)
    for (first[1] = 0; first[1] + 1 < size[1]; first[1] += side)
      for (first[0] = 0; first[0] + 1 < size[0]; first[0] += side) {
        Subject part{.volume = subject.volume,
                     .isovalue = subject.isovalue,
                     .effort = subject.effort,
                     .mesh = {}};
        part.volume.samples.clear();
        std::array<int, 3> last;
        for (std::size_t a = 0; a < 3; ++a) {
          last[a] = std::min(first[a] + side, size[a] - 1);
          part.volume.size[a] = last[a] - first[a] + 1;
        }
        for (int z = first[2]; z <= last[2]; ++z)
          for (int y = first[1]; y <= last[1]; ++y) {
            const auto row = subject.volume.samples.begin() +
                             (static_cast<std::ptrdiff_t>(z) * size[1] + y) * size[0];
            part.volume.samples.insert(part.volume.samples.end(), row + first[0],
                                       row + last[0] + 1);
          }
        sum += encodeIsostarInChunks(part, EncodeOptions{}.maxError, 0).size();
      }
  return sum;
}

Json chunksJson(const Subject& subject, const std::vector<std::byte>& stream, int side) {
  const auto bytes = [&](ModelStart models, bool seesScalars) {
    return chunkBytes(stream, {.side = side, .models = models, .seesScalars = seesScalars});
  };
  const ChunkBytes coarse = bytes(ModelStart::Coarse, false);
  return {{"side", side},
          {"sections", coarse.sections},
          {"differing", coarse.differing},
          {"continued", bytes(ModelStart::Continued, false).layers},
          {"coarse", coarse.layers},
          {"initial", bytes(ModelStart::Initial, false).layers},
          {"coarseSeeingScalars", bytes(ModelStart::Coarse, true).layers},
          {"shared", sharedVertices(stream, side)},
          {"stream", encodeIsostarInChunks(subject, EncodeOptions{}.maxError, side).size()},
          {"cropped", croppedBytes(subject, side)}};
}

}  // namespace

Json chunkCost(const Subject& subject) {
  const auto stream = encodeIsostarInChunks(subject, EncodeOptions{}.maxError, 0);
  StreamInfo info;
  require(inspect(stream, info), "inspect");
  std::size_t layers = 0;
  for (const LayerInfo& layer : info.layers) layers += layer.bytes;
  Json chunks = Json::array();
  for (const int side : {128, 64}) chunks.push_back(chunksJson(subject, stream, side));
  return {{"bytes", stream.size()},
          {"layers", layers},
          {"layerCount", info.layers.size()},
          {"vertices", info.vertices},
          {"chunks", chunks}};
}

}  // namespace isostar::bench
