// A simplex of one whole refinement level of the RBMT (§4.3): Kuhn's subdivision of cells that
// mirror each other.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "grid/lattice.h"

namespace isostar {

/// A path of D steps from the cell's corner with even coordinates to the one with odd coordinates,
/// one axis per step. The order of the axes selects the simplex among the D! of its cell. Simplices
/// are not stored: their neighbours are computed. Coordinates are planes of a lattice.
template <int D>
struct Simplex {
  Coordinates<D> start{};             // the corner that is even on every axis
  std::array<int8_t, D> direction{};  // ±1: on which side of `start` the cell lies
  std::array<int8_t, D> axes{};       // the axis of each step

  /// Vertex 0 is `start`, vertex D the odd corner.
  [[nodiscard]] Coordinates<D> vertex(int i) const {
    Coordinates<D> v = start;
    for (int step = 0; step < i; ++step) v[axes[step]] += direction[axes[step]];
    return v;
  }

  /// The simplex on the other side of the face opposite vertex i; nothing at the box's end. Its
  /// vertex i is the one that is not on the face.
  [[nodiscard]] std::optional<Simplex> across(int i, const Lattice<D>& lattice) const {
    Simplex other = *this;
    if (i > 0 && i < D) {
      std::swap(other.axes[i - 1], other.axes[i]);
      return other;
    }
    const int axis = i == 0 ? axes[0] : axes[D - 1];
    if (i == 0) other.start[axis] += 2 * direction[axis];
    other.direction[axis] = static_cast<int8_t>(-direction[axis]);
    // The shared face lies in a plane orthogonal to `axis`. Is there a cell beyond it?
    const int32_t beyond = i == 0 ? other.start[axis] : start[axis] - direction[axis];
    if (beyond < 0 || beyond > lattice.last[axis]) return std::nullopt;
    return other;
  }

  /// The cell, named by the corner that is least on every axis.
  [[nodiscard]] Coordinates<D> cell() const {
    Coordinates<D> c = start;
    for (int a = 0; a < D; ++a) c[a] -= direction[a] < 0;
    return c;
  }

  /// D!, the number of simplices in a cell.
  static constexpr uint32_t perCell() {
    uint32_t n = 1;
    for (uint32_t i = 2; i <= D; ++i) n *= i;
    return n;
  }

  /// The lexicographic rank of its order of axes, 0 … D! - 1.
  [[nodiscard]] uint32_t rank() const {
    uint32_t rank = 0;
    for (int i = 0; i < D; ++i) {
      uint32_t smaller = 0;
      for (int j = i + 1; j < D; ++j) smaller += axes[j] < axes[i];
      rank = rank * static_cast<uint32_t>(D - i) + smaller;
    }
    return rank;
  }

  /// Its number among all simplices of the lattice, 0 … count - 1.
  [[nodiscard]] std::size_t index(const Lattice<D>& lattice) const {
    const auto c = cell();
    std::size_t at = 0;
    for (int a = D - 1; a >= 0; --a)
      at = at * static_cast<std::size_t>(lattice.last[a]) + static_cast<std::size_t>(c[a]);
    return at * perCell() + rank();
  }
  /// The inverse of index().
  [[nodiscard]] static Simplex at(std::size_t index, const Lattice<D>& lattice) {
    const auto rank = static_cast<uint32_t>(index % perCell());
    index /= perCell();
    Coordinates<D> c;
    for (int a = 0; a < D; ++a) {
      c[a] = static_cast<int32_t>(index % static_cast<std::size_t>(lattice.last[a]));
      index /= static_cast<std::size_t>(lattice.last[a]);
    }
    return inCell(c, rank);
  }
  /// How many simplices the lattice has.
  [[nodiscard]] static std::size_t count(const Lattice<D>& lattice) {
    std::size_t n = perCell();
    for (int a = 0; a < D; ++a) n *= static_cast<std::size_t>(lattice.last[a]);
    return n;
  }

  /// The simplex of a cell by its rank: the inverse of cell() and rank().
  [[nodiscard]] static Simplex inCell(const Coordinates<D>& cell, uint32_t rank) {
    Simplex s;
    for (int a = 0; a < D; ++a) {
      s.start[a] = cell[a] + (cell[a] & 1);
      s.direction[a] = static_cast<int8_t>((cell[a] & 1) != 0 ? -1 : 1);
    }
    std::array<uint32_t, D> digits{};
    for (int i = D - 1; i >= 0; --i) {
      digits[i] = rank % static_cast<uint32_t>(D - i);
      rank /= static_cast<uint32_t>(D - i);
    }
    std::array<bool, D> used{};
    for (int i = 0; i < D; ++i) {
      int axis = 0;
      for (uint32_t skip = digits[i];; ++axis) {
        if (used[axis]) continue;
        if (skip == 0) break;
        --skip;
      }
      used[axis] = true;
      s.axes[i] = static_cast<int8_t>(axis);
    }
    return s;
  }
};

}  // namespace isostar
