// What surrounds a new vertex of the RBMT: its diamond, and the siblings that are told before it.
#pragma once

#include <array>
#include <cstdint>

#include "grid/row_packs.h"

namespace isostar {

/// A neighbour in a Window: rows further and bits further.
struct Step {
  int16_t rows = 0;
  int8_t bits = 0;
};

/// The neighbours of a vertex that is fresh on the axes of a set O. Splitting the diagonal of the
/// cube or face that spans O creates the vertex; its diamond (all simplices around that edge) has
/// the corners v + {±1}^O and, across the other axes N, v + {-1,0,1}^N without v. After K. Weiss,
/// L. De Floriani, Diamond hierarchies of arbitrary dimension (2009).
template <int D>
struct Neighbourhood {
  static constexpr int kMost = static_cast<int>(power(3, D)) + 5;
  std::array<Step, kMost> diamond{};  // the corners, then those across
  std::array<Step, kMost>
      siblings{};  // of the same class, earlier in the order of rows; nearest first
  int cornerCount = 0, acrossCount = 0, siblingCount = 0;
  RowPacks<D> siblingMask;  // those of the siblings that are not outer ones
  RowPacks<D> farMask;  // the nearest kFar vertices of earlier classes outside the diamond that are
                        // not outer ones
  RowPacks<D>
      outerMask;  // the nearest kOuter that are told before and two steps away on two axes or more
  typename RowPacks<D>::Slices slices{};
  int weight = 0;                                               // of all vertices that have one
  static constexpr int kSiblings = 15, kFar = 40, kOuter = 34;  // all there are in space

  /// What a neighbour's sign says of the vertex's own, in 1/kOne of log-odds, rounded from logistic
  /// regressions over volumes of all kinds: of a corner, of one across on a single axis or on
  /// several, of a sibling one step away, of a far one, and of an outer one, which tells a bend
  /// from a slope.
  static constexpr int kOne = 32, kCorner = 32, kBeside = 44, kAcross = 8, kSibling = 8,
                       kFarOne = 1, kOuterOne = -4;

  /// What is summed up in slices: signs of the diamond, as many as the largest one in space has;
  /// how many of its corners and of those across are positive; what those within one step that are
  /// positive weigh.
  struct Seen {
    unsigned diamond, corners, across;
    int weight;
  };
  static constexpr int kDiamondBits = 10, kCountBits = 5;
  static constexpr Seen unpacked(uint32_t sum) {
    constexpr uint32_t kDiamonds = (1u << kDiamondBits) - 1, kCounts = (1u << kCountBits) - 1;
    return {sum & kDiamonds, sum >> kDiamondBits & kCounts,
            sum >> (kDiamondBits + kCountBits) & kCounts,
            static_cast<int>(sum >> (kDiamondBits + 2 * kCountBits))};
  }

  [[nodiscard]] constexpr int diamondCount() const { return cornerCount + acrossCount; }

  constexpr Neighbourhood() = default;
  constexpr explicit Neighbourhood(unsigned newAxes) {
    collect(newAxes, true);
    collect(newAxes, false);
    slice();
  }

  /// By the set of fresh axes; made once, at run time, since the tables would be a large part of a
  /// small decoder.
  using All = std::array<Neighbourhood, 1u << D>;
  static const All& all() {
    static const All kAll = [] {
      All all{};
      for (unsigned o = 1; o < all.size(); ++o) all[o] = Neighbourhood(o);
      return all;
    }();
    return kAll;
  }

 private:
  int farCount = 0, outerCount = 0;
  std::array<std::array<int, D>, kMost> offsets{};  // of the diamond

  constexpr void slice() {
    for (int i = 0; i < diamondCount(); ++i) {
      int axes = 0;
      for (const int d : offsets[i]) axes += d != 0 ? 1 : 0;
      const bool corner = i < cornerCount;
      const uint32_t sign = i < kDiamondBits ? 1u << i : 0u,
                     count = 1u << (corner ? kDiamondBits : kDiamondBits + kCountBits);
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

  constexpr void collect(unsigned newAxes, bool corners) {
    for (int distance = 1; distance <= 4 * D; ++distance) {
      std::array<int, D> d{};
      d.fill(-2);
      for (std::size_t n = power(5, D); n > 0; --n) {
        int squares = 0;
        for (int a = 0; a < D; ++a) squares += d[a] * d[a];
        if (squares == distance) addAt(newAxes, d, corners, distance >= 8);
        for (int a = 0; a < D && ++d[a] == 3; ++a) d[a] = -2;
      }
    }
  }

  constexpr void addAt(unsigned newAxes, const std::array<int, D>& d, bool corners, bool outer) {
    Step step;
    for (int a = 1; a < D; ++a)
      step.rows = static_cast<int16_t>(step.rows + d[a] * Window<D>::rowStride(a));
    step.bits = static_cast<int8_t>(d[0]);
    bool corner = true, beside = true, near = true, earlier = false;
    unsigned theirs = newAxes;
    for (int a = 0; a < D; ++a) {
      const bool inO = (newAxes >> a & 1) != 0;
      if ((d[a] & 1) != 0) theirs ^= 1u << a;
      near = near && d[a] >= -1 && d[a] <= 1;
      corner = corner && (inO ? (d[a] & 1) != 0 : d[a] == 0);
      beside = beside && (!inO || d[a] == 0);
      if (d[a] != 0) earlier = d[a] < 0;  // the outermost axis that differs decides
    }
    const int mine = __builtin_popcount(newAxes), other = __builtin_popcount(theirs);
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
