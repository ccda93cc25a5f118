#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "files/failure.h"
#include "files/text.h"
#include "mesh_io/mesh_formats.h"
#include "mesh_io/word_reader.h"

namespace isostar::native {
namespace {

constexpr size_t kHead = 84, kRecord = 50;

using Corner = std::array<float, 3>;

Corner faceNormal(const std::array<Corner, 3>& p) {
  Corner a, b, n;
  for (int axis = 0; axis < 3; ++axis) {
    a[axis] = p[1][axis] - p[0][axis];
    b[axis] = p[2][axis] - p[0][axis];
  }
  for (int axis = 0; axis < 3; ++axis)
    n[axis] = a[(axis + 1) % 3] * b[(axis + 2) % 3] - a[(axis + 2) % 3] * b[(axis + 1) % 3];
  const float length = std::hypot(n[0], n[1], n[2]);
  for (float& coordinate : n) coordinate = length > 0 ? coordinate / length : 0;
  return n;
}

std::vector<Corner> readBinary(std::span<const std::byte> bytes) {
  std::vector<Corner> corners((bytes.size() - kHead) / kRecord * 3);
  for (size_t t = 0; 3 * t < corners.size(); ++t)
    std::memcpy(&corners[3 * t], bytes.data() + kHead + kRecord * t + 12, 36);
  return corners;
}

std::vector<Corner> readText(std::span<const std::byte> bytes, const std::string& path) {
  std::vector<Corner> corners;
  for (WordReader reader(bytes); !reader.atEnd();) {
    if (reader.word() != "vertex") continue;
    Corner corner;
    for (float& coordinate : corner) {
      if (!parseNumber(reader.word(), coordinate))
        throw Failure(path, text("corner %zu does not have three coordinates", corners.size()));
    }
    corners.push_back(corner);
  }
  if (corners.size() % 3 != 0) throw Failure(path, "ends inside a triangle");
  return corners;
}

/// STL has no vertices, only corners: those at one position become one vertex.
Mesh weld(const std::vector<Corner>& corners) {
  std::vector<uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return corners[a] < corners[b]; });
  Mesh mesh;
  mesh.indices.resize(corners.size());
  const Corner* last = nullptr;
  for (uint32_t corner : order) {
    if (!last || *last != corners[corner])
      mesh.positions.insert(mesh.positions.end(), corners[corner].begin(), corners[corner].end());
    last = &corners[corner];
    mesh.indices[corner] = static_cast<uint32_t>(mesh.positions.size() / 3 - 1);
  }
  return mesh;
}

/// Binary files may begin with "solid" too; only the length distinguishes them from text.
bool isBinary(std::span<const std::byte> bytes) {
  if (bytes.size() < kHead) return false;
  uint32_t triangles;
  std::memcpy(&triangles, bytes.data() + 80, 4);
  return bytes.size() == kHead + kRecord * static_cast<uint64_t>(triangles);
}

bool isText(std::span<const std::byte> bytes) {
  return bytes.size() >= 5 && std::memcmp(bytes.data(), "solid", 5) == 0;
}

}  // namespace

void writeStl(const Mesh& mesh, OutputFile& file) {
  const auto triangles = static_cast<uint32_t>(mesh.indices.size() / 3);
  std::array<char, 80> title{"binary STL by isostar"};
  file.write(title.data(), title.size());
  file.write(&triangles, 4);
  std::array<std::byte, kRecord> record{};
  for (size_t t = 0; t < triangles; ++t) {
    std::array<Corner, 3> corners;
    for (size_t c = 0; c < 3; ++c)
      std::memcpy(&corners[c], &mesh.positions[3 * size_t{mesh.indices[3 * t + c]}], 12);
    const Corner normal = faceNormal(corners);
    std::memcpy(&record[0], &normal, 12);
    std::memcpy(&record[12], &corners, 36);
    file.write(record.data(), record.size());
  }
}

Mesh readStl(std::span<const std::byte> bytes, const std::string& path) {
  if (isBinary(bytes)) return weld(readBinary(bytes));
  if (!isText(bytes)) throw Failure(path, "is not an STL file, or it is cut short");
  return weld(readText(bytes, path));
}

}  // namespace isostar::native
