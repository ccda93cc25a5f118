// The rows of signs around a row, packed into words, so that a few masks and tables count hundreds
// of neighbours.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "grid/window.h"

namespace isostar {

/// The 5^(D-1) rows around a row of a Window, five to a word. A set of neighbours is a mask of the
/// same layout.
template <int D>
struct RowPacks {
  static constexpr std::size_t kWords = power(5, D - 2);
  static constexpr int kBits = Window<D>::kSide;  // of a row in a word
  static_assert(5 * kBits <= 64);
  std::array<uint64_t, kWords> words{};

  /// Packs the rows around `row`, which lies in a Window with two rows on every side.
  static RowPacks around(const uint16_t* row) {
    RowPacks packs;
    for (std::size_t w = 0; w < kWords; ++w) {
      const uint16_t* first = row + kFirst[w];
      for (int i = 0; i < 5; ++i)
        packs.words[w] |= uint64_t{first[i * Window<D>::rowStride(1)]} << (i * kBits);
    }
    return packs;
  }
  /// Flips the sign at bit `at` of the row in the middle if `flipped` is 1; leaves it if it is 0.
  void flip(unsigned flipped, int at) {
    words[kWords / 2] ^= uint64_t{flipped} << (2 * kBits + at);
  }

  /// How many vertices of a mask are positive. The mask is centred on bit `at` of the row in the
  /// middle.
  [[nodiscard]] unsigned count(const RowPacks& mask, int at) const {
    int positive = 0;
    for (std::size_t w = 0; w < kWords; ++w)
      positive += std::popcount(words[w] >> (at - 2) & mask.words[w]);
    return static_cast<unsigned>(positive);
  }

  /// For each of the 3^(D-2) planes of 3^2 neighbours: by the nine signs in it, what they add to
  /// the packed sum that Neighbourhood::unpacked() reads.
  using Slices = std::array<std::array<uint32_t, 512>, power(3, D - 2)>;

  /// The sum over the slices of the 3^D vertices around bit `at` of the row in the middle.
  [[nodiscard]] uint32_t diamond(const Slices& slices, int at) const {
    uint32_t seen = 0;
    for (std::size_t s = 0; s < slices.size(); ++s) {
      const uint64_t rows = words[kInnerWords[s]] >> (at - 1 + kBits);
      seen += slices[s][(rows & 7) | (rows >> (kBits - 3) & 56) | (rows >> (2 * kBits - 6) & 448)];
    }
    return seen;
  }

  /// Adds a neighbour to a mask. `d`: its offset, within ±2 on each axis.
  constexpr void add(const std::array<int, D>& d) {
    std::size_t word = 0;
    for (int a = D - 1; a >= 2; --a) word = word * 5 + static_cast<std::size_t>(d[a] + 2);
    words[word] |= uint64_t{1} << ((d[1] + 2) * kBits + d[0] + 2);
  }

  /// The slice of a neighbour and its bit there. `d`: its offset, within ±1 on each axis.
  static constexpr std::pair<std::size_t, int> sliceOf(const std::array<int, D>& d) {
    std::size_t slice = 0;
    for (int a = D - 1; a >= 2; --a) slice = slice * 3 + static_cast<std::size_t>(d[a] + 1);
    return {slice, (d[1] + 1) * 3 + d[0] + 1};
  }

 private:
  static constexpr std::array<std::size_t, power(3, D - 2)> kInnerWords = [] {
    std::array<std::size_t, power(3, D - 2)> inner{};
    for (std::size_t s = 0; s < inner.size(); ++s) {
      std::size_t word = 0, digits = s;
      for (std::size_t stride = 1, a = 2; a < D; ++a, digits /= 3, stride *= 5)
        word += (digits % 3 + 1) * stride;
      inner[s] = word;
    }
    return inner;
  }();
  static constexpr std::array<int, kWords> kFirst = [] {
    std::array<int, kWords> first{};
    for (std::size_t w = 0; w < kWords; ++w) {
      first[w] = -2 * Window<D>::rowStride(1);
      std::size_t digits = w;
      for (int a = 2; a < D; ++a, digits /= 5)
        first[w] += (static_cast<int>(digits % 5) - 2) * Window<D>::rowStride(a);
    }
    return first;
  }();
};

}  // namespace isostar
