#include "bench/general_codecs.h"

#include <meshoptimizer.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "files/failure.h"

namespace isostar::bench {
namespace {

constexpr int kMeshLevel = 19;
constexpr int kVolumeLevel = 9;  // higher levels take minutes for large volumes

size_t compressedBytes(const void* data, size_t bytes, int level) {
  std::vector<std::byte> room(ZSTD_compressBound(bytes));
  const size_t size = ZSTD_compress(room.data(), room.size(), data, bytes, level);
  if (ZSTD_isError(size)) throw native::Failure("zstd", ZSTD_getErrorName(size));
  return size;
}

using Corner = std::array<uint16_t, 4>;  // the vertex codec needs a multiple of four bytes

/// The lowest corner and the longest side of the bounding box.
struct Range {
  std::array<float, 3> low{INFINITY, INFINITY, INFINITY};
  float side = 0;
};

Range rangeOf(const std::vector<float>& positions) {
  Range range;
  std::array<float, 3> high{-INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < positions.size(); ++i) {
    range.low[i % 3] = std::min(range.low[i % 3], positions[i]);
    high[i % 3] = std::max(high[i % 3], positions[i]);
  }
  for (size_t axis = 0; axis < 3; ++axis)
    range.side = std::max(range.side, high[axis] - range.low[axis]);
  return range;
}

template <class Sample>
size_t zstdBytesAs(const std::vector<float>& samples) {
  std::vector<Sample> narrow(samples.begin(), samples.end());
  return compressedBytes(narrow.data(), narrow.size() * sizeof(Sample), kVolumeLevel);
}

}  // namespace

MeshoptStream encodeMeshopt(const Mesh& mesh, int bits) {
  const Range range = rangeOf(mesh.positions);
  const float step = range.side / static_cast<float>((1 << bits) - 1);
  const size_t vertices = mesh.positions.size() / 3;
  std::vector<Corner> corners(vertices), sorted(vertices);
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    corners[i / 3][i % 3] =
        static_cast<uint16_t>(std::lround((mesh.positions[i] - range.low[i % 3]) / step));

  MeshoptStream result;
  std::vector<uint32_t>& triangles = result.decoded.indices;
  triangles.resize(mesh.indices.size());
  meshopt_optimizeVertexCacheStrip(triangles.data(), mesh.indices.data(), mesh.indices.size(),
                                   vertices);
  meshopt_optimizeVertexFetch(sorted.data(), triangles.data(), triangles.size(), corners.data(),
                              vertices, sizeof(Corner));
  for (const Corner& corner : sorted) {
    for (size_t axis = 0; axis < 3; ++axis)
      result.decoded.positions.push_back(range.low[axis] + step * static_cast<float>(corner[axis]));
  }

  std::vector<unsigned char> buffer(meshopt_encodeVertexBufferBound(vertices, sizeof(Corner)));
  buffer.resize(meshopt_encodeVertexBuffer(buffer.data(), buffer.size(), sorted.data(), vertices,
                                           sizeof(Corner)));
  std::vector<unsigned char> indices(meshopt_encodeIndexBufferBound(triangles.size(), vertices));
  indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), triangles.data(),
                                           triangles.size()));
  buffer.insert(buffer.end(), indices.begin(), indices.end());
  result.bytes = compressedBytes(buffer.data(), buffer.size(), kMeshLevel);
  return result;
}

size_t zstdBytes(const std::vector<float>& samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  const bool whole =
      std::all_of(samples.begin(), samples.end(), [](float s) { return s == std::floor(s); });
  if (whole && *low >= 0 && *high <= UINT8_MAX) return zstdBytesAs<uint8_t>(samples);
  if (whole && *low >= 0 && *high <= UINT16_MAX) return zstdBytesAs<uint16_t>(samples);
  if (whole && *low >= INT16_MIN && *high <= INT16_MAX) return zstdBytesAs<int16_t>(samples);
  return zstdBytesAs<float>(samples);
}

}  // namespace isostar::bench
