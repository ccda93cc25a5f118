// The new vertices of a brick (§5.2), class by class and row by row, with the signs around them.
#pragma once

#include "grid/neighbourhood.h"

namespace isostar {

/// The vertices of the entered brick that have a given number of new axes: one *class*. A vertex
/// whose diamond has both signs is *open*; the sign of any other is deduced. On a level of an
/// adaptive mesh some vertices are absent, and so is every new vertex with an absent one in its
/// diamond: this keeps the mesh conforming.
template <int D>
class NewVertexRows {
 public:
  using Bits = uint32_t;  // bit x is vertex x of a row

  /// A row with vertices of the class.
  struct Row {
    int16_t window;   // the row's number in the Window
    uint16_t brick;   // the row's number in the Brick
    uint8_t newAxes;  // the new axes of its vertices, bit a for axis a
    uint8_t members;  // its vertices of the class
    uint8_t open;     // those whose diamond has both signs
    uint8_t absent;   // those that are not in the mesh

    /// Those whose sign is deduced.
    [[nodiscard]] Bits deduced() const { return members & ~Bits{open} & ~Bits{absent}; }
  };

  /// Finds the rows of a class in a brick. `newAxisCount`: how many new axes the class has, 1 … D.
  /// `absent`: the absent vertices; null where the mesh has all.
  void enter(const Signs<D>& signs, const Signs<D>* absent, std::size_t brickIndex,
             int newAxisCount) {
    const auto at = signs.table().brick(brickIndex);
    changed_ = false;
    signs_.load(signs, at);
    find(signs.lattice(), at, newAxisCount);
    if (absent != nullptr) absent_.load(*absent, at);
    openCount_ = 0;
    // Of eight rows along axis 1, all on new planes of that axis have the same new axes, and so
    // have all others: two vectors are enough.
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

  /// Finds the rows alone, without signs and with no open vertices. They are the same in all bricks
  /// that the lattice's end does not cut. `at`: the brick's coordinates.
  void find(const Lattice<D>& lattice, const Coordinates<D>& at, int newAxisCount) {
    bool last = false;
    for (int a = 0; a < D; ++a) last = last || (at[a] + 1) * kBrickSide > lattice.last[a];
    const int kind = last ? -1 : newAxisCount;
    if (!last && kind_ == kind) return;
    kind_ = kind;
    Bits newOnAxis0 = 0, inside = 0;
    for (int x = 0; x < kBrickSide && at[0] * kBrickSide + x <= lattice.last[0]; ++x) {
      inside |= 1u << x;
      if (lattice.isNew(0, at[0] * kBrickSide + x)) newOnAxis0 |= 1u << x;
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
      const int left = newAxisCount - std::popcount(o);
      const Bits members = left == 1 ? newOnAxis0 : left == 0 ? inside & ~newOnAxis0 : 0;
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

  /// How many rows have vertices of the class; row(i) are these rows, in order.
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const Row& row(int i) const { return rows_[i]; }
  /// How many rows had open vertices when the brick was entered; open(i) are these rows.
  [[nodiscard]] int openCount() const { return openCount_; }
  [[nodiscard]] Row& open(int i) { return rows_[open_[static_cast<std::size_t>(i)]]; }

  /// The signs of a row as in a Window; those of rows around are at the offsets of Steps. A caller
  /// that changes a sign reports it with setChanged().
  [[nodiscard]] uint16_t* signs(const Row& row) { return &signs_.rows[row.window]; }
  [[nodiscard]] const uint16_t* signs(const Row& row) const { return &signs_.rows[row.window]; }
  void setChanged(bool changed) { changed_ = changed_ || changed; }
  /// The absent vertices of a row, in the same layout. Valid only after enter() with `absent`.
  [[nodiscard]] uint16_t* absent(const Row& row) { return &absent_.rows[row.window]; }

  /// Has a sign changed since the brick was entered?
  [[nodiscard]] bool changed() const { return changed_; }
  /// Writes the signs of the brick itself back.
  void store(Signs<D>& signs, std::size_t brickIndex) const {
    auto& rows = signs.writable(brickIndex).rows;
    for (std::size_t r = 0; r < rows.size(); ++r)
      rows[r] = static_cast<uint8_t>(signs_.rows[Window<D>::kOwnRows[r]] >> Window<D>::kHalo);
  }

 private:
  static constexpr std::size_t kRows = power(kBrickSide, D - 1);

  /// Which vertices of eight rows have both signs in their diamond, provided that these are their
  /// new axes.
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

  /// Which vertices of a row have an absent vertex in their diamond.
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
  std::array<uint16_t, kRows> open_;  // the numbers of rows with open vertices
  int openCount_ = 0;
  /// The class of rows_; -1 where they are of a brick that the lattice's end cuts.
  int kind_ = -1;
  bool changed_ = false;
};

}  // namespace isostar
