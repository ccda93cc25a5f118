#include "model/welded_mesh.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace isostar::native {
namespace {

using Position = std::array<float, 3>;
using Corners = std::array<uint32_t, 3>;

Position positionOf(const Mesh& mesh, uint32_t vertex) {
  const float* p = &mesh.positions[3 * size_t{vertex}];
  // -0 becomes 0, so that equal positions have equal bits.
  return {p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f};
}

/// Each vertex's index among the welded positions, which are appended to `out`.
std::vector<uint32_t> weldVertices(const Mesh& mesh, std::vector<float>& out) {
  std::vector<uint32_t> order(mesh.positions.size() / 3), welded(order.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return positionOf(mesh, a) < positionOf(mesh, b); });
  for (size_t i = 0; i < order.size(); ++i) {
    const Position position = positionOf(mesh, order[i]);
    if (i == 0 || position != positionOf(mesh, order[i - 1]))
      out.insert(out.end(), position.begin(), position.end());
    welded[order[i]] = static_cast<uint32_t>(out.size() / 3 - 1);
  }
  return welded;
}

}  // namespace

WeldedMesh weld(const Mesh& mesh) {
  WeldedMesh result;
  const std::vector<uint32_t> welded = weldVertices(mesh, result.mesh.positions);
  std::vector<Corners> triangles;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    Corners corners;
    for (size_t c = 0; c < 3; ++c) corners[c] = welded[mesh.indices[t + c]];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
  }
  result.degenerate = mesh.indices.size() / 3 - triangles.size();
  std::sort(triangles.begin(), triangles.end());
  const auto end = std::unique(triangles.begin(), triangles.end());
  result.doubled = static_cast<size_t>(triangles.end() - end);
  for (auto at = triangles.begin(); at != end; ++at)
    result.mesh.indices.insert(result.mesh.indices.end(), at->begin(), at->end());
  return result;
}

}  // namespace isostar::native
