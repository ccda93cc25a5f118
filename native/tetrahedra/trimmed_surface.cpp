#include "tetrahedra/trimmed_surface.h"

#include <unordered_map>

namespace isostar::native {
namespace {

using measure::Vector3;

/// Cuts triangles where the distance to the boundary, linear along their edges, is 0.
class DomainTrimmer {
 public:
  DomainTrimmer(const Mesh& mesh, std::vector<double> distances)
      : mesh_(mesh), distances_(std::move(distances)) {
    kept_.resize(distances_.size(), UINT32_MAX);
  }

  /// Adds the part of the triangle inside the domain, a polygon of at most four corners.
  void cut(const uint32_t* corners) {
    std::array<uint32_t, 4> polygon{};
    size_t count = 0;
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = corners[i], b = corners[(i + 1) % 3];
      if (isInside(a)) polygon[count++] = kept(a);
      if (isInside(a) != isInside(b)) polygon[count++] = between(a, b);
    }
    for (size_t i = 2; i < count; ++i)
      result_.indices.insert(result_.indices.end(), {polygon[0], polygon[i - 1], polygon[i]});
  }

  Mesh take() { return std::move(result_); }

 private:
  bool isInside(uint32_t vertex) const { return distances_[vertex] >= 0; }

  uint32_t add(const Vector3& p) {
    for (double x : {p.x, p.y, p.z}) result_.positions.push_back(static_cast<float>(x));
    return static_cast<uint32_t>(result_.positions.size() / 3 - 1);
  }

  uint32_t kept(uint32_t vertex) {
    if (kept_[vertex] == UINT32_MAX)
      kept_[vertex] = add(measure::vertexAt(mesh_.positions, vertex));
    return kept_[vertex];
  }

  uint32_t between(uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [found, isNew] = cuts_.try_emplace(uint64_t{a} << 32 | b, 0);
    if (isNew) {
      const double t = distances_[a] / (distances_[a] - distances_[b]);
      const Vector3 from = measure::vertexAt(mesh_.positions, a),
                    to = measure::vertexAt(mesh_.positions, b);
      found->second = add(from + t * (to - from));
    }
    return found->second;
  }

  const Mesh& mesh_;
  std::vector<double> distances_;                // from each vertex to the boundary
  std::vector<uint32_t> kept_;                   // by vertex of the mesh
  std::unordered_map<uint64_t, uint32_t> cuts_;  // by edge
  Mesh result_;
};

}  // namespace

Mesh trimToDomain(const Mesh& mesh, const TetrahedralField& field) {
  std::vector<double> distances(mesh.positions.size() / 3);
  uint32_t near = 0;
  for (size_t v = 0; v < distances.size(); ++v)
    distances[v] = field.domainDistance(measure::vertexAt(mesh.positions, v), near);
  DomainTrimmer trimmer(mesh, std::move(distances));
  for (size_t t = 0; t < mesh.indices.size(); t += 3) trimmer.cut(&mesh.indices[t]);
  return trimmer.take();
}

}  // namespace isostar::native
