// The items that a brick stores, with a halo of one, copied so that every neighbour is at a fixed
// offset.
#pragma once

#include "grid/signs.h"

namespace isostar {

/// `Side` items along each axis of a brick, and one more on either side of them.
template <int D, class Item, int Side>
class HaloWindow {
 public:
  static constexpr int kSide = Side + 2;
  std::array<Item, power(kSide, D)> value{};

  /// By axis: a table, because a compiler that does not unroll a loop over axes would compute
  /// powers again and again.
  static constexpr std::array<int, D> kStrides = [] {
    std::array<int, D> strides{};
    for (int a = 0; a < D; ++a)
      strides[static_cast<std::size_t>(a)] = static_cast<int>(power(kSide, a));
    return strides;
  }();

  /// The offset in `value` between neighbours on an axis.
  static constexpr int stride(int axis) { return kStrides[static_cast<std::size_t>(axis)]; }

 protected:
  /// Fills `value`. `itemsAt(brickIndex)` returns the items of a brick, the first axis fastest;
  /// `nothing` are those of a brick beyond the table.
  template <class ItemsAt>
  void gather(const BrickTable<D>& table, const Coordinates<D>& brick, const Item* nothing,
              ItemsAt itemsAt) {
    std::array<const Item*, power(3, D)> bricks;
    const auto brickIndices = table.around(brick);
    for (std::size_t n = 0; n < bricks.size(); ++n)
      bricks[n] = brickIndices[n] == BrickTable<D>::kNowhere ? nothing : itemsAt(brickIndices[n]);
    for (std::size_t i = 0; i < kSources.size(); ++i) {
      const Item* const* const source = &bricks[kSources[i].firstBrick];
      const std::size_t row = kSources[i].row;
      Item* out = &value[i * kSide];
      out[0] = source[0][row + Side - 1];
      std::copy_n(source[1] + row, Side, out + 1);
      out[kSide - 1] = source[2][row];
    }
  }

 private:
  /// Where a row of the window comes from: the first of three bricks side by side on axis 0, and
  /// the first item in each.
  struct Source {
    uint16_t firstBrick = 0, row = 0;
  };
  static constexpr std::array<Source, power(kSide, D - 1)> kSources = [] {
    std::array<Source, power(kSide, D - 1)> sources{};
    std::array<int, D> v{};
    v.fill(-1);
    for (Source& source : sources) {
      std::size_t n = 0, row = 0;
      for (int a = D - 1; a >= 1; --a) {
        n = n * 3 + static_cast<std::size_t>((v[a] + Side) / Side);
        row = row * Side + static_cast<std::size_t>(v[a] & (Side - 1));
      }
      source = {static_cast<uint16_t>(n * 3), static_cast<uint16_t>(row * Side)};
      for (int a = 1; a < D && ++v[a] == Side + 1; ++a) v[a] = -1;
    }
    return sources;
  }();
};

}  // namespace isostar
