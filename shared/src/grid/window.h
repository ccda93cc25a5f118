// A brick of signs with a halo, copied so that every neighbour of a vertex is at a fixed offset.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "grid/signs.h"
#include "util/cold_path.h"

namespace isostar {

/// The signs of planes -kHalo … 7 + kHalo of a brick on every axis: a row of vertices is a 16-bit
/// word, bit x + kHalo of which is vertex x. Beyond the lattice the signs are mirrored.
template <int D>
class Window {
 public:
  static constexpr int kHalo = 2;
  static constexpr int kSide = kBrickSide + 2 * kHalo;
  static constexpr int kRows = static_cast<int>(power(kSide, D - 1));

  /// How many rows lie between neighbours on axis a ≥ 1.
  static constexpr int rowStride(int axis) { return kRowStrides[static_cast<std::size_t>(axis)]; }
  static constexpr std::array<int, D> kRowStrides = [] {
    std::array<int, D> strides{};
    for (int a = 1; a < D; ++a)
      strides[static_cast<std::size_t>(a)] = static_cast<int>(power(kSide, a - 1));
    return strides;
  }();
  /// The number of the row through the brick's vertex with outer coordinates `outer` (axis 0 is
  /// ignored), each within [-kHalo, 8 + kHalo).
  static constexpr int row(const Coordinates<D>& outer) {
    int at = 0;
    for (int a = D - 1; a >= 1; --a) at = at * kSide + outer[a] + kHalo;
    return at;
  }

  /// Copies the signs in and around a brick, given by its brick coordinates.
  void load(const Signs<D>& signs, const Coordinates<D>& brick) {
    const auto& lattice = signs.lattice();
    bool interior = true;
    for (int a = 0; a < D; ++a)
      interior = interior && brick[a] > 0 &&
                 brick[a] * kBrickSide + kBrickSide + kHalo <= lattice.last[a] + 1;
    const BricksAround bricks = bricksAround(signs, brick);
    copy(bricks);
    if (interior) return;
    mirrorRows(bricks, lattice, brick);
    mirrorAlongRows(lattice, brick[0] * kBrickSide);
  }

  /// The rows, axis 1 fastest.
  std::array<uint16_t, kRows> rows;

  /// Eight rows that follow each other along axis 1, as one vector.
  using Rows [[gnu::vector_size(16)]] = uint16_t;
  [[nodiscard]] Rows eightFrom(int row) const {
    Rows eight;
    std::memcpy(&eight, &rows[static_cast<std::size_t>(row)], sizeof eight);
    return eight;
  }

  /// The window's row of each row of the brick itself.
  static constexpr std::array<int16_t, power(kBrickSide, D - 1)> kOwnRows = [] {
    std::array<int16_t, power(kBrickSide, D - 1)> own{};
    Coordinates<D> v{};
    for (int16_t& r : own) {
      r = static_cast<int16_t>(row(v));
      for (int a = 1; a < D && ++v[a] == kBrickSide; ++a) v[a] = 0;
    }
    return own;
  }();

 private:
  using BricksAround = std::array<const uint8_t*, power(3, D)>;

  /// The rows of the 3^D bricks around one, three per row of bricks. For a brick beyond the table
  /// the middle one stands in, until mirrored signs replace its rows.
  static BricksAround bricksAround(const Signs<D>& signs, const Coordinates<D>& brick) {
    const auto brickIndices = signs.table().around(brick);
    const std::size_t own = brickIndices[brickIndices.size() / 2];
    BricksAround bricks;
    for (std::size_t n = 0; n < bricks.size(); ++n)
      bricks[n] = signs.brickAt(brickIndices[n] == BrickTable<D>::kNowhere ? own : brickIndices[n])
                      .rows.data();
    return bricks;
  }

  static uint16_t joined(uint8_t before, uint8_t here, uint8_t after) {
    return static_cast<uint16_t>(
        (before >> (kBrickSide - kHalo) | here << kHalo | after << (kBrickSide + kHalo)) &
        ((1 << kSide) - 1));
  }

  /// Rows come in runs along axis 1: the last of one brick, all of the next, the first of the one
  /// after. Their bytes are copied first, so that the compiler joins many rows at a time.
  void copy(const BricksAround& bricks) {
    /// By brick along axis 0: before, here and after.
    std::array<std::array<uint8_t, kRows>, 3> bytes;
    std::array<int, D> plane{};
    plane.fill(-kHalo);
    for (std::size_t r = 0; r < kRows; r += kSide) {
      std::size_t n = 0, first = 0;
      for (int a = D - 1; a >= 2; --a) {
        n = n * 3 + static_cast<std::size_t>(plane[a] + kBrickSide) / kBrickSide;
        first = first * kBrickSide + static_cast<std::size_t>(plane[a] & (kBrickSide - 1));
      }
      for (std::size_t side = 0; side < 3; ++side) {
        const uint8_t* const* source = &bricks[n * 9 + side];
        const std::size_t run = first * kBrickSide;
        uint8_t* out = &bytes[side][r];
        std::copy_n(source[0] + run + kBrickSide - kHalo, kHalo, out);
        std::copy_n(source[3] + run, kBrickSide, out + kHalo);
        std::copy_n(source[6] + run, kHalo, out + kHalo + kBrickSide);
      }
      for (int a = 2; a < D && ++plane[a] == kBrickSide + kHalo; ++a) plane[a] = -kHalo;
    }
    for (std::size_t r = 0; r < kRows; ++r) rows[r] = joined(bytes[0][r], bytes[1][r], bytes[2][r]);
  }

  /// Replaces rows beyond the lattice by those that they mirror.
  ISOSTAR_COLD void mirrorRows(const BricksAround& bricks, const Lattice<D>& lattice,
                               const Coordinates<D>& brick) {
    // For each outer axis and plane of the window: which of the three bricks, which row in it, and
    // is it mirrored?
    std::array<std::array<uint8_t, kSide>, D> brickAtPlane{}, rowAt{};
    std::array<uint32_t, D> images{};
    for (int a = 1; a < D; ++a) {
      for (int i = 0; i < kSide; ++i) {
        const int32_t at = brick[a] * kBrickSide + i - kHalo, plane = lattice.mirrored(a, at);
        // Planes far beyond the lattice mirror ones that were not copied. Their signs are never
        // used.
        const int32_t away = std::clamp((plane >> 3) - brick[a], -1, 1);
        brickAtPlane[a][i] = static_cast<uint8_t>((away + 1) * static_cast<int>(power(3, a)));
        rowAt[a][i] = static_cast<uint8_t>(plane & 7);
        images[a] |= static_cast<uint32_t>(plane != at) << i;
      }
    }
    std::array<int, D> i{};
    for (std::size_t first = 0; first < kRows; first += kSide) {
      std::size_t outerBrick = 0, outerRow = 0;
      uint32_t open = images[1];
      for (int a = D - 1; a >= 2; --a) {
        outerBrick += brickAtPlane[a][i[a]];
        outerRow = (outerRow + rowAt[a][i[a]]) * kBrickSide;
        if ((images[a] >> i[a] & 1) != 0) open = (1u << kSide) - 1;
      }
      for (; open != 0; open &= open - 1) {
        const int r = std::countr_zero(open);
        const std::size_t n = outerBrick + brickAtPlane[1][r], row = outerRow + rowAt[1][r];
        rows[first + static_cast<std::size_t>(r)] =
            joined(bricks[n][row], bricks[n + 1][row], bricks[n + 2][row]);
      }
      for (int a = 2; a < D && ++i[a] == kSide; ++a) i[a] = 0;
    }
  }

  /// Mirrors the bits of rows beyond the lattice on axis 0. All rows have their ends at the same
  /// bits, so that the compiler takes several at a time.
  ISOSTAR_COLD void mirrorAlongRows(const Lattice<D>& lattice, int32_t start) {
    const int end = lattice.last[0] - start + kHalo;  // the bit of the last plane
    if (lattice.last[0] < kHalo) {
      for (uint16_t& bits : rows) bits = static_cast<uint16_t>(mirroredFlat(lattice, bits));
      return;
    }
    if (start == 0) {
      for (uint16_t& bits : rows)
        bits = static_cast<uint16_t>((bits & ~3u) | (bits >> 4 & 1) | (bits >> 2 & 2));
    }
    if (end < kSide - 1) {
      const uint32_t inside = (2u << end) - 1, all = (1u << kSide) - 1;
      for (uint16_t& bits : rows) {
        bits = static_cast<uint16_t>(((bits & inside) | (bits >> (end - 1) & 1) << (end + 1) |
                                      (bits >> (end - 2) & 1) << (end + 2)) &
                                     all);
      }
    }
  }

  /// For a lattice of one or two planes on axis 0, where mirror images are mirrored again.
  ISOSTAR_COLD static uint32_t mirroredFlat(const Lattice<D>& lattice, uint32_t bits) {
    uint32_t result = 0;
    for (int i = 0; i < kSide; ++i)
      result |= (bits >> (lattice.mirrored(0, i - kHalo) + kHalo) & 1) << i;
    return result;
  }
};

}  // namespace isostar
