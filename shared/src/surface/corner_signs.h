// The signs at the ends of all edges and the corners of all cells of a brick, many at a time.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "grid/tube.h"

namespace isostar {

/// A bit for each vertex of a brick: bit x + 8 y of word z.
using BrickWords = decltype(VertexSet<3>::words);

/// The signs of a brick's vertices, and of the vertices one step further on each set of axes. Bits
/// of vertices outside the lattice are meaningless.
class CornerSigns {
 public:
  /// Not inlined, to keep the WebAssembly decoder small.
  [[gnu::noinline]] CornerSigns(const Signs<3>& signs, std::size_t brickIndex) {
    const auto& table = signs.table();
    const auto brick = table.brick(brickIndex);
    for (unsigned c = 0; c < 8; ++c) {
      std::size_t other = brickIndex;
      for (int a = 0; a < 3; ++a)
        other += (c >> a & 1) != 0 && brick[a] + 1 < table.count(a) ? table.stride(a) : 0;
      words_[c] = wordsOf(signs.brickAt(other));
    }
    // So far words_[c] are the signs of the next brick on the axes c. Axis by axis they become
    // those of the next vertices.
    for (unsigned c = 0; c < 8; ++c)
      if ((c & 4) != 0) words_[c] = steppedOnZ(words_[c ^ 4], words_[c]);
    for (unsigned c = 0; c < 8; ++c)
      if ((c & 2) != 0) words_[c] = steppedOnY(words_[c ^ 2], words_[c]);
    for (unsigned c = 0; c < 8; ++c)
      if ((c & 1) != 0) words_[c] = steppedOnX(words_[c ^ 1], words_[c]);
  }

  /// The crossing edges along a set of axes, by their least vertices in plane z. An edge along
  /// several axes is the diagonal of a face or cell that the RBMT has (§4.3): it joins the vertex
  /// that is even on these axes with the one that is odd on them.
  [[nodiscard]] uint64_t crossedEdges(unsigned axes, unsigned z) const {
    if (std::has_single_bit(axes)) return words_[0][z] ^ words_[axes][z];
    uint64_t crossed = 0;
    for (unsigned odd = axes;; odd = (odd - 1) & axes) {
      crossed |= (words_[odd][z] ^ words_[axes ^ odd][z]) & oddOn(odd, axes, z);
      if (odd == 0) return crossed;
    }
  }
  /// The crossing cells, by their least vertices in plane z.
  [[nodiscard]] uint64_t crossedCells(unsigned z) const {
    uint64_t some = 0, all = ~uint64_t{0};
    for (const auto& words : words_) {
      some |= words[z];
      all &= words[z];
    }
    return some & ~all;
  }
  /// The signs of a cell's corners: bit c for the corner that is further on the axes c. `at`: x + 8
  /// y of the cell's least vertex.
  [[nodiscard]] unsigned around(unsigned z, unsigned at) const {
    unsigned signs = 0;
    for (unsigned c = 0; c < 8; ++c) signs |= static_cast<unsigned>(words_[c][z] >> at & 1) << c;
    return signs;
  }

 private:
  static BrickWords wordsOf(const Brick<3>& brick) {
    BrickWords words{};
    for (unsigned z = 0; z < 8; ++z) {
      for (unsigned y = 0; y < 8; ++y) words[z] |= uint64_t{brick.rows[z * 8 + y]} << y * 8;
    }
    return words;
  }
  static BrickWords steppedOnX(const BrickWords& here, const BrickWords& next) {
    constexpr uint64_t kFirst = 0x0101010101010101;
    BrickWords words;
    for (unsigned z = 0; z < 8; ++z)
      words[z] = (here[z] >> 1 & ~(kFirst << 7)) | (next[z] & kFirst) << 7;
    return words;
  }
  static BrickWords steppedOnY(const BrickWords& here, const BrickWords& next) {
    BrickWords words;
    for (unsigned z = 0; z < 8; ++z) words[z] = here[z] >> 8 | next[z] << 56;
    return words;
  }
  static BrickWords steppedOnZ(const BrickWords& here, const BrickWords& next) {
    BrickWords words;
    for (unsigned z = 0; z < 8; ++z) words[z] = z < 7 ? here[z + 1] : next[0];
    return words;
  }
  /// The vertices of plane z that are odd on the axes `odd` and even on the others of `axes`.
  static uint64_t oddOn(unsigned odd, unsigned axes, unsigned z) {
    const std::array<uint64_t, 3> odds{0xAAAAAAAAAAAAAAAA, 0xFF00FF00FF00FF00,
                                       (z & 1) != 0 ? ~uint64_t{0} : 0};
    uint64_t both = ~uint64_t{0};
    for (unsigned a = 0; a < 3; ++a) {
      if ((axes >> a & 1) != 0) both &= (odd >> a & 1) != 0 ? odds[a] : ~odds[a];
    }
    return both;
  }

  std::array<BrickWords, 8> words_;  // by set of axes
};

/// The vertices of a brick from which edges along a set of axes stay inside the lattice. `brick`:
/// its brick coordinates.
inline BrickWords insideOf(const Lattice<3>& lattice, const Coordinates<3>& brick, unsigned axes) {
  Coordinates<3> last = lattice.last;
  for (unsigned a = 0; a < 3; ++a) last[a] -= (axes >> a & 1) != 0 ? 1 : 0;
  return VertexSet<3>::upTo(last, brick).words;
}

}  // namespace isostar
