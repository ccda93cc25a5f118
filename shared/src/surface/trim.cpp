// Trims a mesh in place: numbers the kept vertices, cuts triangles, then moves positions and
// normals.
#include "surface/trim.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "util/cold_path.h"

namespace isostar {
namespace {

class Trimming {
 public:
  Trimming(const std::vector<float>& values, const Limits& limits, Mesh& mesh)
      : values_(values), limits_(limits), mesh_(mesh) {}

  ISOSTAR_COLD Error run() {
    std::size_t whole = 0, cut = 0;
    for (std::size_t t = 0; t < mesh_.indices.size(); t += 3) {
      const int kept =
          keeps(mesh_.indices[t]) + keeps(mesh_.indices[t + 1]) + keeps(mesh_.indices[t + 2]);
      whole += kept == 3 ? 1 : 0;
      cut += kept == 1 || kept == 2 ? 1 : 0;
    }
    if (3 * whole == mesh_.indices.size()) return Error::None;
    // The most that exists at the same time: a mesh and its successor, numbers of vertices, edges.
    const uint64_t vertices = values_.size(),
                   perVertex = (mesh_.normals.empty() ? 3 : 6) * sizeof(float);
    const uint64_t before = vertices * (perVertex + sizeof(float) + 2 * sizeof(uint32_t)) +
                            mesh_.indices.capacity() * sizeof(uint32_t);
    const uint64_t made = (vertices + 2 * cut) * perVertex +
                          (whole + 2 * cut) * 3 * sizeof(uint32_t) + 2 * cut * sizeof(Edge);
    if (before + made > limits_.memory) return Error::OverLimit;
    number();
    edges_.reserve(2 * cut);
    cutTriangles(whole + 2 * cut);
    if (kept_ + edges_.size() > std::min<uint64_t>(limits_.vertices, UINT32_MAX))
      return Error::OverLimit;
    moveVertices(mesh_.positions, false);
    if (!mesh_.normals.empty()) moveVertices(mesh_.normals, true);
    return Error::None;
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// An edge that is cut, from a vertex that is kept to one that is not. `before`: the previous cut
  /// edge from the same kept vertex.
  struct Edge {
    uint32_t kept, other, before;
  };

  [[nodiscard]] bool keeps(uint32_t vertex) const { return values_[vertex] >= 0; }

  ISOSTAR_COLD void number() {
    numbers_.resize(values_.size());
    last_.assign(values_.size(), kNone);
    for (uint32_t v = 0; v < values_.size(); ++v) {
      if (keeps(v)) numbers_[v] = kept_++;
    }
  }

  /// The number of the vertex on an edge that is cut; these vertices follow those that are kept.
  ISOSTAR_COLD uint32_t onEdge(uint32_t kept, uint32_t other) {
    if (!keeps(kept)) std::swap(kept, other);
    for (uint32_t e = last_[kept]; e != kNone; e = edges_[e].before) {
      if (edges_[e].other == other) return kept_ + e;
    }
    const auto e = static_cast<uint32_t>(edges_.size());
    edges_.push_back({kept, other, last_[kept]});
    last_[kept] = e;
    return kept_ + e;
  }

  /// The kept part of a triangle is a polygon of at most four corners. `most`: an upper bound of
  /// the number of triangles.
  ISOSTAR_COLD void cutTriangles(std::size_t most) {
    std::vector<uint32_t> to(3 * most);
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh_.indices.size(); t += 3) {
      std::array<uint32_t, 4> polygon{};
      std::size_t corners = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const uint32_t a = mesh_.indices[t + i], b = mesh_.indices[i == 2 ? t : t + i + 1];
        if (keeps(a)) polygon[corners++] = numbers_[a];
        if (keeps(a) != keeps(b)) polygon[corners++] = onEdge(a, b);
      }
      for (std::size_t i = 2; i < corners; ++i, count += 3) {
        to[count] = polygon[0];
        to[count + 1] = polygon[i - 1];
        to[count + 2] = polygon[i];
      }
    }
    to.resize(count);
    mesh_.indices.swap(to);
  }

  /// Replaces positions, or unit normals, by those of the kept vertices, followed by those on cut
  /// edges.
  ISOSTAR_COLD void moveVertices(std::vector<float>& values, bool unit) const {
    std::vector<float> moved(3 * (kept_ + edges_.size()));
    float* to = moved.data();
    for (uint32_t v = 0; v < values_.size(); ++v) {
      if (!keeps(v)) continue;
      for (std::size_t i = 0; i < 3; ++i) *to++ = values[std::size_t{v} * 3 + i];
    }
    for (const Edge& edge : edges_) {
      const float *a = &values[std::size_t{edge.kept} * 3],
                  *b = &values[std::size_t{edge.other} * 3];
      const double t = values_[edge.kept] / (double{values_[edge.kept]} - values_[edge.other]);
      std::array<double, 3> p;
      double squares = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = a[i] + t * (double{b[i]} - a[i]);
        squares += p[i] * p[i];
      }
      const double length = unit ? std::sqrt(squares) : 1;
      for (std::size_t i = 0; i < 3; ++i)
        *to++ = length > 0 ? static_cast<float>(p[i] / length) : a[i];
    }
    values.swap(moved);
  }

  const std::vector<float>& values_;
  const Limits& limits_;
  Mesh& mesh_;
  uint32_t kept_ = 0;
  std::vector<uint32_t> numbers_, last_;  // by vertex: its new number; the last cut edge from it
  std::vector<Edge> edges_;
};

}  // namespace

Error trim(const std::vector<float>& values, const Limits& limits, Mesh& mesh) {
  return Trimming(values, limits, mesh).run();
}

}  // namespace isostar
