#include "measure/topology.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace isostar::measure {
namespace {

/// Which vertices hang together (union-find with halved paths).
class Groups {
 public:
  explicit Groups(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t of(uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }
  void join(uint32_t a, uint32_t b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<uint32_t> parent_;
};

uint64_t countGroups(Groups& groups, const std::vector<uint8_t>& member) {
  uint64_t count = 0;
  for (size_t v = 0; v < member.size(); ++v)
    count += member[v] && groups.of(static_cast<uint32_t>(v)) == v;
  return count;
}

/// An edge as one triangle runs along it.
struct Side {
  uint32_t low, high;
  bool rising;
  bool sameEdge(const Side& other) const { return low == other.low && high == other.high; }
};

/// All sides, those of one edge next to each other: counted into their lower vertex, then sorted
/// within it.
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

std::vector<Side> sidesOf(const Mesh& mesh, Topology& topology, Groups& groups,
                          std::vector<uint8_t>& used) {
  std::vector<Side> sides;
  sides.reserve(mesh.indices.size());
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t corner[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    ++topology.triangles;
    groups.join(corner[0], corner[1]);
    groups.join(corner[1], corner[2]);
    for (int c = 0; c < 3; ++c) {
      const uint32_t from = corner[c], to = corner[(c + 1) % 3];
      used[from] = 1;
      sides.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }
  return sides;
}

void countEdges(const std::vector<Side>& sides, size_t vertices, Topology& topology) {
  Groups rim(vertices);
  std::vector<uint8_t> onRim(vertices);
  for (size_t i = 0, end; i < sides.size(); i = end) {
    for (end = i + 1; end < sides.size() && sides[end].sameEdge(sides[i]);) ++end;
    ++topology.edges;
    if (end - i > 2) ++topology.nonManifoldEdges;
    if (end - i == 2 && sides[i].rising == sides[i + 1].rising) ++topology.misorientedEdges;
    if (end - i > 1) continue;
    ++topology.boundaryEdges;
    onRim[sides[i].low] = onRim[sides[i].high] = 1;
    rim.join(sides[i].low, sides[i].high);
  }
  topology.boundaryLoops = countGroups(rim, onRim);
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
  Groups groups(vertices);
  std::vector<uint8_t> used(vertices);
  const std::vector<Side> sides = sidesOf(mesh, topology, groups, used);
  topology.vertices = static_cast<uint64_t>(std::count(used.begin(), used.end(), 1));
  topology.components = countGroups(groups, used);
  countEdges(sortedSides(sides, vertices), vertices, topology);
  return topology;
}

}  // namespace isostar::measure
