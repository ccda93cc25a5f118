// The scalars of a brick and its surroundings, copied so that every neighbour is at a fixed offset.
#pragma once

#include "grid/halo_window.h"
#include "scalars/scalars.h"

namespace isostar {

template <int D>
struct ScalarWindow : HaloWindow<D, int32_t, kBrickSide> {
  using ScalarWindow::HaloWindow::stride;

  /// The offset of vertex x in row r of the brick.
  static int index(std::size_t r, int x) { return kRowIndex[r] + x; }

  void load(const Scalars<D>& scalars, const BrickTable<D>& table, const Coordinates<D>& brick) {
    this->gather(table, brick, scalars.nothing().value.data(),
                 [&](std::size_t brickIndex) { return scalars.at(brickIndex).value.data(); });
  }

 private:
  static constexpr std::array<int, power(kBrickSide, D - 1)> kRowIndex = [] {
    std::array<int, power(kBrickSide, D - 1)> index{};
    for (std::size_t r = 0; r < index.size(); ++r) {
      int at = 1;
      std::size_t digits = r;
      for (int a = 1; a < D; ++a, digits /= kBrickSide)
        at += (static_cast<int>(digits % kBrickSide) + 1) * stride(a);
      index[r] = at;
    }
    return index;
  }();
};

}  // namespace isostar
