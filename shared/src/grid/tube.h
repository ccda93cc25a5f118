// The tube's vertices in a brick of the finest level: those whose scalars determine the surface.
#pragma once

#include <bit>

#include "grid/window.h"

namespace isostar {

/// The two classes of the tube's vertices (§5.3). AxisEnds: ends of crossing axis edges, all that
/// Polygonizer::Cubes needs. DiagonalEnds: the other ends of crossing edges of the RBMT, its
/// diagonals, which only Polygonizer::Tetrahedra needs.
enum class Members : uint8_t { AxisEnds, DiagonalEnds };

/// A set of vertices of a brick, as bits. A word holds eight rows.
template <int D>
struct VertexSet {
  static constexpr std::size_t kWords = power(kBrickSide, D) / 64;
  std::array<uint64_t, kWords> words{};

  /// The vertices of a brick that lie on planes 0 … last of each axis. `brick`: its brick
  /// coordinates.
  static VertexSet upTo(const Coordinates<D>& last, const Coordinates<D>& brick) {
    VertexSet set;
    set.words.fill(~uint64_t{0});
    Coordinates<D> planes;
    bool all = true;
    for (int a = 0; a < D; ++a) {
      planes[a] = std::clamp(last[a] + 1 - brick[a] * kBrickSide, 0, kBrickSide);
      all = all && planes[a] == kBrickSide;
    }
    if (all) return set;
    set.words.fill(0);
    const uint64_t row = (1u << planes[0]) - 1;
    Coordinates<D> v{};
    for (std::size_t r = 0; r < kWords * kBrickSide; ++r) {
      bool in = true;
      for (int a = 1; a < D; ++a) in = in && v[a] < planes[a];
      if (in) set.words[r / kBrickSide] |= row << r % kBrickSide * kBrickSide;
      for (int a = 1; a < D && ++v[a] == kBrickSide; ++a) v[a] = 0;
    }
    return set;
  }

  /// The bit of vertex x of row r, in word r / 8.
  static uint64_t bit(std::size_t r, int x) {
    return uint64_t{1} << (r % kBrickSide * kBrickSide + static_cast<unsigned>(x));
  }
  [[nodiscard]] bool has(std::size_t r, int x) const {
    return (words[r / kBrickSide] & bit(r, x)) != 0;
  }
  [[nodiscard]] std::size_t count() const {
    std::size_t sum = 0;
    for (const uint64_t word : words) sum += static_cast<std::size_t>(std::popcount(word));
    return sum;
  }
  /// Calls visit(r, x) for each vertex in order.
  template <class Visit>
  void forEach(Visit visit) const {
    for (std::size_t w = 0; w < kWords; ++w) {
      for (uint64_t open = words[w]; open != 0; open &= open - 1) {
        const int at = std::countr_zero(open);
        visit(w * kBrickSide + static_cast<unsigned>(at) / kBrickSide, at % kBrickSide);
      }
    }
  }
};

template <int D>
class Tube {
 public:
  /// Finds the members of one class in a brick. Not inlined, to keep the WebAssembly decoder small.
  [[gnu::noinline]] void enter(const Signs<D>& signs, std::size_t brickIndex, Members members) {
    table_ = &signs.table();
    at_ = table_->brick(brickIndex);
    window_.load(signs, at_);
    findAxisEnds(signs.lattice());
    if (members == Members::AxisEnds) return;
    const VertexSet<D> ends = members_;
    addDiagonalEnds(signs);
    keepOnly([&](std::size_t r, int x) { return !ends.has(r, x); });
  }

  /// Adds the diagonal ends to the axis ends that were entered.
  void addDiagonalEnds(const Signs<D>& signs) {
    const auto inside = VertexSet<D>::upTo(signs.lattice().last, at_);
    Coordinates<D> v{};
    for (std::size_t r = 0; r < kRows; ++r) {
      const unsigned shift = r % kBrickSide * kBrickSide;
      const uint64_t ends = uint64_t{diagonalEnds(v)} << shift & inside.words[r / kBrickSide];
      members_.words[r / kBrickSide] |= ends;
      positive_.words[r / kBrickSide] |=
          uint64_t{bits(Window<D>::row(v)) >> Window<D>::kHalo} << shift & ends;
      for (int a = 1; a < D && ++v[a] == kBrickSide; ++a) v[a] = 0;
    }
  }

  /// Removes the members for which `keeps(r, x)` is false.
  template <class Keeps>
  void keepOnly(Keeps keeps) {
    VertexSet<D> kept;
    members_.forEach([&](std::size_t r, int x) {
      if (keeps(r, x)) kept.words[r / kBrickSide] |= VertexSet<D>::bit(r, x);
    });
    members_ = kept;
    for (std::size_t w = 0; w < kept.words.size(); ++w) positive_.words[w] &= kept.words[w];
  }

  /// Does the brick have no members?
  [[nodiscard]] bool empty() const {
    return std::all_of(members_.words.begin(), members_.words.end(),
                       [](uint64_t w) { return w == 0; });
  }
  /// The members found in the entered brick.
  [[nodiscard]] const VertexSet<D>& members() const { return members_; }
  /// The signs of the entered brick.
  [[nodiscard]] const Window<D>& window() const { return window_; }
  /// The table of the signs that were entered, which is not owned.
  [[nodiscard]] const BrickTable<D>& table() const { return *table_; }
  /// The brick's coordinates among bricks.
  [[nodiscard]] const Coordinates<D>& at() const { return at_; }
  /// `row`: of the window.
  [[nodiscard]] bool positive(int row, int x) const {
    return (window_.rows[row] >> (x + Window<D>::kHalo) & 1) != 0;
  }

  /// How many of the 2 D neighbours along the axes are positive. `row`: of the window.
  [[nodiscard]] int positivesBeside(int row, int x) const {
    int count = std::popcount(bits(row) >> (x + Window<D>::kHalo - 1) & 5u);
    for (int a = 1; a < D; ++a)
      count +=
          positive(row - Window<D>::rowStride(a), x) + positive(row + Window<D>::rowStride(a), x);
    return count;
  }

  /// The axes on which vertex x of row r is odd.
  [[nodiscard]] static unsigned parity(std::size_t r, int x) {
    unsigned odd = static_cast<unsigned>(x) & 1;
    for (int a = 1; a < D; ++a, r /= kBrickSide) odd |= static_cast<unsigned>(r & 1) << a;
    return odd;
  }

  /// Calls visit(window row, brick row, x) for each member of one sign in order.
  template <class Visit>
  void forEach(bool positive, Visit visit) const {
    VertexSet<D> set = positive_;
    if (!positive) {
      for (std::size_t w = 0; w < set.words.size(); ++w)
        set.words[w] = members_.words[w] & ~positive_.words[w];
    }
    set.forEach([&](std::size_t r, int x) { visit(Window<D>::kOwnRows[r], r, x); });
  }

  /// Calls visit(window row, brick row, x) for each member in order.
  template <class Visit>
  void forEach(Visit visit) const {
    members_.forEach([&](std::size_t r, int x) { visit(Window<D>::kOwnRows[r], r, x); });
  }

 private:
  static constexpr std::size_t kRows = power(kBrickSide, D - 1);
  [[nodiscard]] uint32_t bits(int row) const { return window_.rows[row]; }

  /// Finds the ends of crossing axis edges, eight rows at a time.
  void findAxisEnds(const Lattice<D>& lattice) {
    members_ = VertexSet<D>::upTo(lattice.last, at_);
    for (std::size_t w = 0; w < members_.words.size(); ++w) {
      const int first = Window<D>::kOwnRows[w * kBrickSide];
      const auto mine = window_.eightFrom(first);
      auto crossing = (mine ^ mine >> 1) | (mine ^ mine << 1);
      for (int a = 1; a < D; ++a)
        crossing |= (mine ^ window_.eightFrom(first - Window<D>::rowStride(a))) |
                    (mine ^ window_.eightFrom(first + Window<D>::rowStride(a)));
      members_.words[w] &= joined(crossing >> Window<D>::kHalo);
      positive_.words[w] = members_.words[w] & joined(mine >> Window<D>::kHalo);
    }
  }
  /// The lower bytes of eight rows.
  static uint64_t joined(typename Window<D>::Rows rows) {
    uint64_t word = 0;
    for (unsigned y = 0; y < kBrickSide; ++y)
      word |= uint64_t{static_cast<uint8_t>(rows[y])} << y * kBrickSide;
    return word;
  }

  /// The vertices of a row that are ends of crossing diagonals. An edge of the RBMT along several
  /// axes joins a vertex that is even on all of them to one that is odd on all of them.
  [[nodiscard]] uint32_t diagonalEnds(const Coordinates<D>& v) const {
    const uint32_t mine = bits(Window<D>::row(v));
    uint32_t crossing = 0;
    Coordinates<D> d;
    d.fill(-1);
    for (std::size_t n = 0; n < power(3, D); ++n) {
      int axes = 0, odd = 0;
      Coordinates<D> other = v;
      for (int a = 1; a < D; ++a) {
        other[a] += d[a];
        axes += d[a] != 0;
        odd += d[a] != 0 && (v[a] & 1) != 0;
      }
      if (axes + (d[0] != 0) >= 2 && (odd == 0 || odd == axes)) {
        const uint32_t theirs = bits(Window<D>::row(other));
        const uint32_t differ = (mine ^ (d[0] == 0  ? theirs
                                         : d[0] < 0 ? theirs << 1
                                                    : theirs >> 1)) >>
                                Window<D>::kHalo;
        crossing |= d[0] == 0 ? differ : differ & (odd != 0 ? 0xAAu : 0x55u);
      }
      for (int a = 0; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
    return crossing & 0xFF;
  }

  const BrickTable<D>* table_ = nullptr;
  Coordinates<D> at_{};
  Window<D> window_;
  VertexSet<D> members_, positive_;
};

}  // namespace isostar
