// The vertices that a bisection makes in a brick (§5.2), row by row, with the signs around them.
#pragma once

#include "grid/neighbourhood.h"

namespace isostar {

/// Of the brick that has been entered: its vertices that are fresh on a number of axes, their
/// *class*. One whose diamond has both signs is *open*; the sign of any other is deduced. Of an
/// adaptive octave some are absent from the mesh: as is every vertex with an absent one in its
/// diamond, so that the mesh conforms.
template <int D>
class NewVertexRows {
 public:
  using Bits = uint32_t;  // bit x is vertex x of a row

  /// A row with vertices of the class.
  struct Row {
    int16_t window;   // in the Window
    uint16_t brick;   // in the Brick
    uint8_t newAxes;  // the axes on which its vertices are fresh
    uint8_t members;  // its vertices of the class
    uint8_t open;     // those whose diamond has both signs
    uint8_t absent;   // those that are not in the mesh

    /// Those whose sign is deduced.
    [[nodiscard]] Bits deduced() const { return members & ~Bits{open} & ~Bits{absent}; }
  };

  /// `absent`: null where all are in the mesh.
  void enter(const Signs<D>& signs, const Signs<D>* absent, std::size_t brickIndex, int dimension) {
    const auto at = signs.table().brick(brickIndex);
    changed_ = false;
    signs_.load(signs, at);
    find(signs.lattice(), at, dimension);
    if (absent != nullptr) absent_.load(*absent, at);
    openCount_ = 0;
    // Of eight rows along axis 1, those on its fresh planes have the same axes, and the others
    // have.
    std::array<typename Window<D>::Rows, 2> crossed{};
    std::array<int, 2> eights{-1, -1};
    for (int i = 0; i < count_; ++i) {
      Row& row = rows_[i];
      const std::size_t kind = row.newAxes >> 1 & 1;
      const int eight = row.brick / kBrickSide, inEight = row.brick % kBrickSide;
      if (eights[kind] != eight) crossed[kind] = crossing(row.window - inEight, row.newAxes);
      eights[kind] = eight;
      row.absent =
          absent == nullptr ? uint8_t{0} : static_cast<uint8_t>(besideAbsent(row) & row.members);
      row.open = static_cast<uint8_t>(crossed[kind][inEight] & row.members & ~row.absent);
      open_[static_cast<std::size_t>(openCount_)] = static_cast<uint16_t>(i);
      openCount_ += row.open != 0 ? 1 : 0;
    }
  }

  /// The rows alone, with no signs around and nothing open: in all bricks but the last ones the
  /// same.
  void find(const Lattice<D>& lattice, const Coordinates<D>& at, int dimension) {
    bool last = false;
    for (int a = 0; a < D; ++a) last = last || (at[a] + 1) * kBrickSide > lattice.last[a];
    const int kind = last ? -1 : dimension;
    if (!last && kind_ == kind) return;
    kind_ = kind;
    Bits newAxes = 0, inside = 0;
    for (int x = 0; x < kBrickSide && at[0] * kBrickSide + x <= lattice.last[0]; ++x) {
      inside |= 1u << x;
      if (lattice.isNew(0, at[0] * kBrickSide + x)) newAxes |= 1u << x;
    }
    count_ = 0;
    Coordinates<D> v{};
    for (std::size_t r = 0; r < kRows; ++r) {
      unsigned o = 0;
      bool in = true;
      for (int a = 1; a < D; ++a) {
        const int32_t plane = at[a] * kBrickSide + v[a];
        in = in && plane <= lattice.last[a];
        if (lattice.isNew(a, plane)) o |= 1u << a;
      }
      const int left = dimension - std::popcount(o);
      const Bits members = left == 1 ? newAxes : left == 0 ? inside & ~newAxes : 0;
      if (in && members != 0) {
        rows_[count_++] = {Window<D>::kOwnRows[r],
                           static_cast<uint16_t>(r),
                           static_cast<uint8_t>(o | static_cast<unsigned>(left)),
                           static_cast<uint8_t>(members),
                           0,
                           0};
      }
      for (int a = 1; a < D && ++v[a] == kBrickSide; ++a) v[a] = 0;
    }
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const Row& row(int i) const { return rows_[i]; }
  /// Of the rows that had open vertices when the brick was entered.
  [[nodiscard]] int openCount() const { return openCount_; }
  [[nodiscard]] Row& open(int i) { return rows_[open_[static_cast<std::size_t>(i)]]; }

  /// The signs of a row as in a Window, and those of the rows around at Steps from it; who writes
  /// says so by setChanged().
  [[nodiscard]] uint16_t* signs(const Row& row) { return &signs_.rows[row.window]; }
  [[nodiscard]] const uint16_t* signs(const Row& row) const { return &signs_.rows[row.window]; }
  void setChanged(bool changed) { changed_ = changed_ || changed; }
  /// The same of absent vertices.
  [[nodiscard]] uint16_t* absent(const Row& row) { return &absent_.rows[row.window]; }

  /// Has a sign turned since the brick was entered?
  [[nodiscard]] bool changed() const { return changed_; }
  void store(Signs<D>& signs, std::size_t brickIndex) const {
    auto& rows = signs.writable(brickIndex).rows;
    for (std::size_t r = 0; r < rows.size(); ++r)
      rows[r] = static_cast<uint8_t>(signs_.rows[Window<D>::kOwnRows[r]] >> Window<D>::kHalo);
  }

 private:
  static constexpr std::size_t kRows = power(kBrickSide, D - 1);

  /// Which vertices of eight rows have a diamond of both signs, if they are fresh on these axes:
  /// all at once.
  [[nodiscard]] typename Window<D>::Rows crossing(int first, unsigned newAxes) const {
    const auto& n = neighbourhoods_[newAxes];
    typename Window<D>::Rows some{}, all = ~some;
    for (int i = 0; i < n.diamondCount(); ++i) {
      const auto rows =
          signs_.eightFrom(first + n.diamond[i].rows) >> (Window<D>::kHalo + n.diamond[i].bits);
      some |= rows;
      all &= rows;
    }
    return some & ~all;
  }

  /// Which vertices of a row have a diamond with a vertex that is not in the mesh.
  [[nodiscard]] Bits besideAbsent(const Row& row) const {
    const auto& n = neighbourhoods_[row.newAxes];
    Bits any = 0;
    for (int i = 0; i < n.diamondCount(); ++i) {
      any |= static_cast<Bits>(absent_.rows[row.window + n.diamond[i].rows]) >>
             (Window<D>::kHalo + n.diamond[i].bits);
    }
    return any;
  }

  const typename Neighbourhood<D>::All& neighbourhoods_ = Neighbourhood<D>::all();
  Window<D> signs_, absent_;
  std::array<Row, kRows> rows_;
  int count_ = 0;
  std::array<uint16_t, kRows> open_;  // which of them have open vertices
  int openCount_ = 0;
  int kind_ = -1;  // the class that rows_ are of; -1 where they are of a last brick
  bool changed_ = false;
};

}  // namespace isostar
