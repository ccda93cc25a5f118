// Topological invariants of the piecewise linear isosurface on simplices of any dimension.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <ostream>
#include <vector>

#include "bisection/leaves.h"

namespace isostar {

/// Components and Euler characteristic of the isosurface and of its boundary.
struct Invariants {
  int64_t components = 0, euler = 0, boundaryComponents = 0, boundaryEuler = 0;
  friend bool operator==(const Invariants&, const Invariants&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Invariants& i) {
    return out << i.components << " components, Euler characteristic " << i.euler << "; boundary "
               << i.boundaryComponents << ", " << i.boundaryEuler;
  }
};

/// A complex of simplices, given by the numbers of their vertices. Its isosurface has one cell in
/// each crossing simplex.
class CellularSurface {
 public:
  using Face = std::vector<uint64_t>;  // ascending

  explicit CellularSurface(std::vector<Face> crossing, const std::map<uint64_t, bool>& positive)
      : positive_(positive) {
    for (const auto& s : crossing) {
      std::size_t first = none();
      for (uint32_t subset = 1; subset < 1u << s.size(); ++subset) {
        Face face;
        for (std::size_t i = 0; i < s.size(); ++i) {
          if ((subset >> i & 1) != 0) face.push_back(s[i]);
        }
        if (!crosses(face)) continue;
        const auto cell = cells_.try_emplace(face, cells_.size());
        if (cell.second) parent_.push_back(parent_.size());
        first = first == none() ? cell.first->second : first;
        parent_[root(cell.first->second)] = root(first);
      }
    }
  }
  [[nodiscard]] int64_t components() {
    int64_t count = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) count += root(i) == i;
    return count;
  }
  [[nodiscard]] int64_t euler() const {
    int64_t sum = 0;
    for (const auto& [face, number] : cells_) sum += face.size() % 2 == 0 ? 1 : -1;
    return sum;
  }
  [[nodiscard]] bool crosses(const Face& face) const {
    return std::any_of(face.begin(), face.end(),
                       [&](uint64_t v) { return positive_.at(v) != positive_.at(face.front()); });
  }

 private:
  static constexpr std::size_t none() { return ~std::size_t{0}; }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  const std::map<uint64_t, bool>& positive_;
  std::map<Face, std::size_t> cells_;
  std::vector<std::size_t> parent_;
};

/// The invariants of the isosurface in some simplices, whose vertices are identified by position.
template <int D, class Positive>
Invariants invariantsOf(const Hierarchy<D>& hierarchy,
                        const std::vector<TaggedSimplex<D>>& simplices, const Positive& positive) {
  std::map<uint64_t, bool> signs;
  std::vector<CellularSurface::Face> crossing;
  std::map<CellularSurface::Face, int> facets;
  for (const auto& s : simplices) {
    CellularSurface::Face face;
    for (const auto& v : s.vertices) {
      const auto p = hierarchy.position(v);
      uint64_t number = 0;
      for (int a = D - 1; a >= 0; --a)
        number =
            number * static_cast<uint64_t>(hierarchy.box()[a] + 1) + static_cast<uint64_t>(p[a]);
      signs[number] = positive(v);
      face.push_back(number);
    }
    if (std::all_of(face.begin(), face.end(),
                    [&](uint64_t v) { return signs.at(v) == signs.at(face.front()); }))
      continue;
    std::sort(face.begin(), face.end());
    for (std::size_t i = 0; i < face.size(); ++i) {
      auto facet = face;
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
      ++facets[facet];
    }
    crossing.push_back(face);
  }
  CellularSurface surface(crossing, signs);
  std::vector<CellularSurface::Face> ends;
  for (const auto& [facet, count] : facets) {
    if (count == 1 && surface.crosses(facet)) ends.push_back(facet);
  }
  CellularSurface boundary(ends, signs);
  return {surface.components(), surface.euler(), boundary.components(), boundary.euler()};
}

}  // namespace isostar
