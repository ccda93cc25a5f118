#include "tetrahedra/marching_tetrahedra.h"

#include <bit>
#include <unordered_map>

namespace isostar::native {
namespace {

using measure::Vector3;

/// For each set of positive corners a permutation that preserves the orientation and puts the
/// positive corners first, or a single negative corner before them.
constexpr std::array<std::array<uint8_t, 4>, 16> kPositiveFirst = {{{0, 1, 2, 3},
                                                                    {0, 1, 2, 3},
                                                                    {1, 0, 3, 2},
                                                                    {0, 1, 2, 3},
                                                                    {2, 3, 0, 1},
                                                                    {0, 2, 3, 1},
                                                                    {1, 2, 0, 3},
                                                                    {3, 2, 1, 0},
                                                                    {3, 2, 1, 0},
                                                                    {0, 3, 1, 2},
                                                                    {1, 3, 2, 0},
                                                                    {2, 3, 0, 1},
                                                                    {2, 3, 0, 1},
                                                                    {1, 0, 3, 2},
                                                                    {0, 1, 2, 3},
                                                                    {0, 1, 2, 3}}};

class Surface {
 public:
  Surface(const TetrahedralMesh& mesh, double isovalue) : mesh_(mesh), isovalue_(isovalue) {}

  void cut(const Corners4& corners) {
    unsigned positive = 0;
    for (size_t i = 0; i < 4; ++i) positive |= unsigned(isPositive(corners[i])) << i;
    const auto& order = kPositiveFirst[positive];
    const Corners4 p = {corners[order[0]], corners[order[1]], corners[order[2]], corners[order[3]]};
    switch (std::popcount(positive)) {
      case 1:
        return add(on(p[0], p[1]), on(p[0], p[2]), on(p[0], p[3]));
      case 2:
        add(on(p[0], p[2]), on(p[0], p[3]), on(p[1], p[3]));
        return add(on(p[0], p[2]), on(p[1], p[3]), on(p[1], p[2]));
      case 3:  // the negative corner comes first
        return add(on(p[0], p[1]), on(p[0], p[3]), on(p[0], p[2]));
      default:
        return;
    }
  }

  Mesh take() { return std::move(surface_); }

 private:
  bool isPositive(uint32_t point) const { return mesh_.values[point] > isovalue_; }

  uint32_t on(uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [found, isNew] =
        vertices_.try_emplace(uint64_t{a} << 32 | b, uint32_t(surface_.positions.size() / 3));
    if (isNew) {
      const double t = (isovalue_ - mesh_.values[a]) / (double{mesh_.values[b]} - mesh_.values[a]);
      const Vector3 p = mesh_.points[a] + t * (mesh_.points[b] - mesh_.points[a]);
      for (double x : {p.x, p.y, p.z}) surface_.positions.push_back(static_cast<float>(x));
    }
    return found->second;
  }

  void add(uint32_t a, uint32_t b, uint32_t c) {
    surface_.indices.insert(surface_.indices.end(), {a, b, c});
  }

  const TetrahedralMesh& mesh_;
  double isovalue_;
  Mesh surface_;
  std::unordered_map<uint64_t, uint32_t> vertices_;  // by edge
};

}  // namespace

Mesh isosurfaceOf(const TetrahedralMesh& mesh, double isovalue) {
  Surface surface(mesh, isovalue);
  for (const Corners4& corners : mesh.tetrahedra) surface.cut(corners);
  return surface.take();
}

}  // namespace isostar::native
