// What surrounds a new vertex of the RBMT: its diamond, and the siblings that are told before it.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "window.h"

namespace isostar {

/// A neighbour in a Window: rows further and bits further.
struct Step {
  int16_t rows = 0;
  int8_t bits = 0;
};

/// The 5^(D-1) rows around one, five to a word, so that neighbours are counted by a mask.
template <int D>
struct RowPacks {
  static constexpr std::size_t kWords = power(5, D - 2);
  static constexpr int kBits = Window<D>::kSide;  // of a row in a word
  static_assert(5 * kBits <= 64);
  std::array<uint64_t, kWords> words{};

  /// The rows around a row of a window.
  static RowPacks around(const uint16_t* row) {
    RowPacks packs;
    for (std::size_t w = 0; w < kWords; ++w) {
      const uint16_t* first = row + kFirst[w];
      for (int i = 0; i < 5; ++i) packs.words[w] |= uint64_t{first[i * Window<D>::rowStride(1)]} << (i * kBits);
    }
    return packs;
  }
  /// Turns the sign at bit `at` of the row in the middle, if it is to be turned (1 or 0).
  void flip(unsigned turned, int at) { words[kWords / 2] ^= uint64_t{turned} << (2 * kBits + at); }

  /// How many vertices of a mask are positive, seen from bit `at` of the row in the middle.
  [[nodiscard]] unsigned count(const RowPacks& mask, int at) const {
    int positive = 0;
    for (std::size_t w = 0; w < kWords; ++w) positive += std::popcount(words[w] >> (at - 2) & mask.words[w]);
    return static_cast<unsigned>(positive);
  }

  /// For the nine (3^2) signs of each plane of the 3^D around: what they add to Neighbourhood::Seen.
  using Slices = std::array<std::array<uint32_t, 512>, power(3, D - 2)>;

  /// The slices' sum, seen from bit `at` of the row in the middle.
  [[nodiscard]] uint32_t diamond(const Slices& slices, int at) const {
    uint32_t seen = 0;
    for (std::size_t s = 0; s < slices.size(); ++s) {
      const uint64_t rows = words[kNearWords[s]] >> (at - 1 + kBits);
      seen += slices[s][(rows & 7) | (rows >> (kBits - 3) & 56) | (rows >> (2 * kBits - 6) & 448)];
    }
    return seen;
  }

  /// Adds a neighbour, two steps away at the most on each axis, to a mask.
  constexpr void add(const std::array<int, D>& d) {
    std::size_t word = 0;
    for (int a = D - 1; a >= 2; --a) word = word * 5 + static_cast<std::size_t>(d[a] + 2);
    words[word] |= uint64_t{1} << ((d[1] + 2) * kBits + d[0] + 2);
  }

  /// The word, and the bit among its nine, of a neighbour one step away at the most on each axis.
  static constexpr std::pair<std::size_t, int> sliceOf(const std::array<int, D>& d) {
    std::size_t slice = 0;
    for (int a = D - 1; a >= 2; --a) slice = slice * 3 + static_cast<std::size_t>(d[a] + 1);
    return {slice, (d[1] + 1) * 3 + d[0] + 1};
  }

 private:
  static constexpr std::array<std::size_t, power(3, D - 2)> kNearWords = [] {
    std::array<std::size_t, power(3, D - 2)> near{};
    for (std::size_t s = 0; s < near.size(); ++s) {
      std::size_t word = 0, digits = s;
      for (std::size_t place = 1, a = 2; a < D; ++a, digits /= 3, place *= 5) word += (digits % 3 + 1) * place;
      near[s] = word;
    }
    return near;
  }();
  static constexpr std::array<int, kWords> kFirst = [] {
    std::array<int, kWords> first{};
    for (std::size_t w = 0; w < kWords; ++w) {
      first[w] = -2 * Window<D>::rowStride(1);
      std::size_t digits = w;
      for (int a = 2; a < D; ++a, digits /= 5) first[w] += (static_cast<int>(digits % 5) - 2) * Window<D>::rowStride(a);
    }
    return first;
  }();
};

/// The neighbours of a vertex that is fresh on the axes of a set O. Splitting the diagonal of the cube or face that
/// spans O creates the vertex; its diamond (all simplices around that edge) has the corners v + {±1}^O and, across the
/// other axes N, v + {-1,0,1}^N without v. After K. Weiss, L. De Floriani, Diamond hierarchies of arbitrary dimension (2009).
template <int D>
struct Neighbourhood {
  static constexpr int kMost = static_cast<int>(power(3, D)) + 5;
  std::array<Step, kMost> diamond{};   // the corners, then those across
  std::array<Step, kMost> siblings{};  // of the same class, earlier in the order of rows; nearest first
  int cornerCount = 0, acrossCount = 0, siblingCount = 0;
  RowPacks<D> siblingMask;  // those of the siblings that are not outer ones
  RowPacks<D> farMask;      // the nearest kFar vertices of earlier classes outside the diamond that are not outer ones
  RowPacks<D> outerMask;    // the nearest kOuter that are told before and two steps away on two axes or more
  typename RowPacks<D>::Slices slices{};
  int weight = 0;  // of all vertices that have one
  static constexpr int kSiblings = 15, kFar = 40, kOuter = 34;  // all there are in space

  /// What a neighbour's sign says of the vertex's own, in 1/kOne of log-odds, rounded from logistic regressions over volumes of
  /// all kinds: of a corner, of one across on a single axis or on several, of a sibling one step away, of a far one, and of an
  /// outer one, which tells a bend from a slope.
  static constexpr int kOne = 32, kCorner = 32, kBeside = 44, kAcross = 8, kSibling = 8, kFarOne = 1, kOuterOne = -4;

  /// What is summed up in slices: signs of the diamond, as many as the largest one in space has; how many of its corners and
  /// of those across are positive; what those within one step that are positive weigh.
  struct Seen {
    unsigned diamond, corners, across;
    int weight;
  };
  static constexpr int kDiamondBits = 10, kCountBits = 5;
  static constexpr Seen unpacked(uint32_t sum) {
    constexpr uint32_t kDiamonds = (1u << kDiamondBits) - 1, kCounts = (1u << kCountBits) - 1;
    return {sum & kDiamonds, sum >> kDiamondBits & kCounts, sum >> (kDiamondBits + kCountBits) & kCounts,
            static_cast<int>(sum >> (kDiamondBits + 2 * kCountBits))};
  }

  [[nodiscard]] constexpr int diamondCount() const { return cornerCount + acrossCount; }

  constexpr Neighbourhood() = default;
  constexpr explicit Neighbourhood(unsigned fresh) {
    collect(fresh, true);
    collect(fresh, false);
    slice();
  }

 private:
  int farCount = 0, outerCount = 0;
  std::array<std::array<int, D>, kMost> offsets{};  // of the diamond

  constexpr void slice() {
    for (int i = 0; i < diamondCount(); ++i) {
      int axes = 0;
      for (const int d : offsets[i]) axes += d != 0 ? 1 : 0;
      const bool corner = i < cornerCount;
      const uint32_t sign = i < kDiamondBits ? 1u << i : 0u, count = 1u << (corner ? kDiamondBits : kDiamondBits + kCountBits);
      addToSlices(offsets[i], sign | count, corner ? kCorner : axes == 1 ? kBeside : kAcross);
    }
  }

  constexpr void addToSlices(const std::array<int, D>& d, uint32_t fields, int itsWeight) {
    const auto [plane, bit] = RowPacks<D>::sliceOf(d);
    fields += static_cast<uint32_t>(itsWeight) << (kDiamondBits + 2 * kCountBits);
    for (uint32_t signs = 0; signs < 512; ++signs) {
      if ((signs >> bit & 1) != 0) slices[plane][signs] += fields;
    }
    weight += itsWeight;
  }

  constexpr void collect(unsigned fresh, bool corners) {
    for (int distance = 1; distance <= 4 * D; ++distance) {
      std::array<int, D> d{};
      d.fill(-2);
      for (std::size_t n = power(5, D); n > 0; --n) {
        int squares = 0;
        for (int a = 0; a < D; ++a) squares += d[a] * d[a];
        if (squares == distance) place(fresh, d, corners, distance >= 8);
        for (int a = 0; a < D && ++d[a] == 3; ++a) d[a] = -2;
      }
    }
  }

  constexpr void place(unsigned fresh, const std::array<int, D>& d, bool corners, bool outer) {
    Step step;
    for (int a = 1; a < D; ++a) step.rows = static_cast<int16_t>(step.rows + d[a] * Window<D>::rowStride(a));
    step.bits = static_cast<int8_t>(d[0]);
    bool corner = true, beside = true, near = true, earlier = false;
    unsigned theirs = fresh;
    for (int a = 0; a < D; ++a) {
      const bool inO = (fresh >> a & 1) != 0;
      if ((d[a] & 1) != 0) theirs ^= 1u << a;
      near = near && d[a] >= -1 && d[a] <= 1;
      corner = corner && (inO ? (d[a] & 1) != 0 : d[a] == 0);
      beside = beside && (!inO || d[a] == 0);
      if (d[a] != 0) earlier = d[a] < 0;  // the outermost axis that differs decides
    }
    const int mine = __builtin_popcount(fresh), other = __builtin_popcount(theirs);
    if (near && (corner || beside)) {
      if (corner != corners) return;
      offsets[cornerCount + acrossCount] = d;
      diamond[cornerCount + acrossCount] = step;
      ++(corner ? cornerCount : acrossCount);
      return;
    }
    const bool sibling = other == mine && earlier;
    if (!corners || !(sibling || other == 0 || other > mine)) return;
    const bool listed = sibling && siblingCount < kSiblings;
    if (listed) siblings[siblingCount++] = step;
    if (listed && near) addToSlices(d, 0, kSibling);
    if (outer) {
      if (outerCount++ >= kOuter) return;
      outerMask.add(d);
      weight += kOuterOne;
    } else if (listed) {
      siblingMask.add(d);
    } else if (!sibling && farCount < kFar) {
      farMask.add(d);
      weight += kFarOne;
      ++farCount;
    }
  }
};

}  // namespace isostar
