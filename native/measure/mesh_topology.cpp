#include "measure/mesh_topology.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace isostar::measure {
namespace {

/// Connected components of vertices (union-find with path halving).
class Components {
 public:
  explicit Components(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  uint32_t of(uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }
  void join(uint32_t a, uint32_t b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<uint32_t> parent_;
};

uint64_t countComponents(Components& components, const std::vector<uint8_t>& member) {
  uint64_t count = 0;
  for (size_t v = 0; v < member.size(); ++v)
    count += member[v] && components.of(static_cast<uint32_t>(v)) == v;
  return count;
}

/// An edge as one triangle traverses it.
struct Side {
  uint32_t low, high;
  bool rising;
  bool sameEdge(const Side& other) const { return low == other.low && high == other.high; }
};

/// All sides, with those of one edge next to each other: bucket sort by the lower vertex, then a
/// sort within each bucket.
std::vector<Side> sortedSides(const std::vector<Side>& sides, size_t vertices) {
  std::vector<uint64_t> start(vertices + 1);
  for (const Side& side : sides) ++start[side.low + size_t{1}];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Side> sorted(sides.size());
  std::vector<uint64_t> next(start.begin(), start.end() - 1);
  for (const Side& side : sides) sorted[next[side.low]++] = side;
  for (size_t v = 0; v < vertices; ++v)
    std::sort(sorted.begin() + static_cast<ptrdiff_t>(start[v]),
              sorted.begin() + static_cast<ptrdiff_t>(start[v + 1]),
              [](const Side& a, const Side& b) { return a.high < b.high; });
  return sorted;
}

std::vector<Side> sidesOf(const Mesh& mesh, Topology& topology, Components& components,
                          std::vector<uint8_t>& used) {
  std::vector<Side> sides;
  sides.reserve(mesh.indices.size());
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t corner[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    ++topology.triangles;
    components.join(corner[0], corner[1]);
    components.join(corner[1], corner[2]);
    for (int c = 0; c < 3; ++c) {
      const uint32_t from = corner[c], to = corner[(c + 1) % 3];
      used[from] = 1;
      sides.push_back({.low = std::min(from, to), .high = std::max(from, to), .rising = from < to});
    }
  }
  return sides;
}

void countEdges(const std::vector<Side>& sides, size_t vertices, Topology& topology) {
  Components border(vertices);
  std::vector<uint8_t> onBorder(vertices);
  for (size_t i = 0, end; i < sides.size(); i = end) {
    for (end = i + 1; end < sides.size() && sides[end].sameEdge(sides[i]);) ++end;
    ++topology.edges;
    if (end - i > 2) ++topology.nonManifoldEdges;
    if (end - i == 2 && sides[i].rising == sides[i + 1].rising) ++topology.misorientedEdges;
    if (end - i > 1) continue;
    ++topology.boundaryEdges;
    onBorder[sides[i].low] = onBorder[sides[i].high] = 1;
    border.join(sides[i].low, sides[i].high);
  }
  topology.boundaryLoops = countComponents(border, onBorder);
}

}  // namespace

std::optional<int64_t> Topology::genus() const {
  const int64_t doubled =
      2 * static_cast<int64_t>(components) - euler() - static_cast<int64_t>(boundaryLoops);
  if (nonManifoldEdges > 0 || misorientedEdges > 0 || doubled < 0 || doubled % 2 != 0) return {};
  return doubled / 2;
}

Topology topologyOf(const Mesh& mesh) {
  const size_t vertices = mesh.positions.size() / 3;
  Topology topology;
  Components components(vertices);
  std::vector<uint8_t> used(vertices);
  const std::vector<Side> sides = sidesOf(mesh, topology, components, used);
  topology.vertices = static_cast<uint64_t>(std::count(used.begin(), used.end(), 1));
  topology.components = countComponents(components, used);
  countEdges(sortedSides(sides, vertices), vertices, topology);
  return topology;
}

}  // namespace isostar::measure
