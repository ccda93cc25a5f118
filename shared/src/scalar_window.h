// A brick's scalars with those next to it, copied where every neighbour is a fixed offset away.
#pragma once

#include "scalars.h"

namespace isostar {

template <int D>
struct ScalarWindow {
  static constexpr int kSide = kBrickSide + 2;
  std::array<int32_t, power(kSide, D)> value{};

  static constexpr int stride(int axis) { return static_cast<int>(power(kSide, axis)); }
  /// Of vertex x in row r of the brick.
  static int index(std::size_t r, int x) { return kRowIndex[r] + x; }

  void load(const Scalars<D>& scalars, const BrickTable<D>& table, const Coordinates<D>& brick) {
    std::array<const int32_t*, power(3, D)> near;
    for (std::size_t n = 0; n < near.size(); ++n) {
      std::size_t place = 0, digits = n;
      bool inside = true;
      for (int a = 0; a < D; ++a, digits /= 3) {
        const int32_t at = brick[a] + static_cast<int32_t>(digits % 3) - 1;
        inside = inside && at >= 0 && at < table.count(a);
        place += static_cast<std::size_t>(at) * table.stride(a);
      }
      near[n] = inside ? scalars.at(place).value.data() : scalars.nothing().value.data();
    }
    for (std::size_t i = 0; i < kSources.size(); ++i) {
      const int32_t* const* const source = &near[kSources[i].near];
      const std::size_t row = kSources[i].row;
      int32_t* out = &value[i * kSide];
      out[0] = source[0][row + kBrickSide - 1];
      std::copy_n(source[1] + row, kBrickSide, out + 1);
      out[kSide - 1] = source[2][row];
    }
  }

 private:
  /// Where a row of the window comes from: the first of three bricks in a row, and the first vertex in each.
  struct Source {
    uint16_t near = 0, row = 0;
  };
  static constexpr std::array<Source, power(kSide, D - 1)> kSources = [] {
    std::array<Source, power(kSide, D - 1)> sources{};
    std::array<int, D> v{};
    v.fill(-1);
    for (Source& source : sources) {
      std::size_t n = 0, row = 0;
      for (int a = D - 1; a >= 1; --a) {
        n = n * 3 + static_cast<std::size_t>((v[a] + kBrickSide) / kBrickSide);
        row = row * kBrickSide + static_cast<std::size_t>(v[a] & (kBrickSide - 1));
      }
      source = {static_cast<uint16_t>(n * 3), static_cast<uint16_t>(row * kBrickSide)};
      for (int a = 1; a < D && ++v[a] == kBrickSide + 1; ++a) v[a] = -1;
    }
    return sources;
  }();

  static constexpr std::array<int, power(kBrickSide, D - 1)> kRowIndex = [] {
    std::array<int, power(kBrickSide, D - 1)> index{};
    for (std::size_t r = 0; r < index.size(); ++r) {
      int at = 1;
      std::size_t digits = r;
      for (int a = 1; a < D; ++a, digits /= kBrickSide) at += (static_cast<int>(digits % kBrickSide) + 1) * stride(a);
      index[r] = at;
    }
    return index;
  }();
};

}  // namespace isostar
