#include "bench/simplifier.h"

#include <meshoptimizer.h>

namespace isostar::bench {
namespace {

/// Drops the vertices that no triangle uses.
Mesh compacted(const Mesh& mesh, std::vector<uint32_t> triangles) {
  constexpr size_t kStride = 3 * sizeof(float);
  const size_t vertices = mesh.positions.size() / 3;
  Mesh result;
  result.indices = std::move(triangles);
  result.positions.resize(mesh.positions.size());
  const size_t used =
      meshopt_optimizeVertexFetch(result.positions.data(), result.indices.data(),
                                  result.indices.size(), mesh.positions.data(), vertices, kStride);
  result.positions.resize(3 * used);
  return result;
}

}  // namespace

Mesh simplified(const Mesh& mesh, double ratio) {
  constexpr float kAnyError = 1e9f;
  std::vector<uint32_t> triangles(mesh.indices.size());
  const size_t target =
      3 * static_cast<size_t>(static_cast<double>(mesh.indices.size() / 3) * ratio);
  triangles.resize(meshopt_simplify(triangles.data(), mesh.indices.data(), mesh.indices.size(),
                                    mesh.positions.data(), mesh.positions.size() / 3,
                                    3 * sizeof(float), target, kAnyError, 0, nullptr));
  return compacted(mesh, std::move(triangles));
}

}  // namespace isostar::bench
