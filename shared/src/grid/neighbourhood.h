// The neighbours of a new vertex of the RBMT: its diamond, and the vertices whose signs are coded
// before its own.
#pragma once

#include <array>
#include <cstdint>

#include "grid/row_packs.h"

namespace isostar {

/// The offset of a neighbour in a Window, in rows and in bits.
struct NeighbourOffset {
  int16_t rows = 0;
  int8_t bits = 0;
};

/// The neighbours of a vertex whose new axes are the set O. Splitting the diagonal of the cube or
/// face that spans O creates the vertex. Its diamond (all simplices around that edge) has the
/// corners v + {±1}^O and, across the other axes N, v + {-1,0,1}^N without v. After K. Weiss, L. De
/// Floriani, Diamond hierarchies of arbitrary dimension (2009).
///
/// Vertices with as many new axes form a class; classes with more new axes are coded earlier.
template <int D>
struct Neighbourhood {
  static constexpr int kMost = static_cast<int>(power(3, D)) + 5;
  std::array<NeighbourOffset, kMost> diamond{};  // the corners, then those across
  /// Of the same class, earlier in the order of rows; nearest first.
  std::array<NeighbourOffset, kMost> siblings{};
  int cornerCount = 0, acrossCount = 0, siblingCount = 0;
  RowPacks<D> siblingMask;  // the siblings that are not outer vertices
  /// The nearest kFar vertices of earlier classes that are neither in the diamond nor outer
  /// vertices.
  RowPacks<D> farMask;
  /// The nearest kOuter vertices that are coded earlier and lie two steps away on at least two
  /// axes.
  RowPacks<D> outerMask;
  typename RowPacks<D>::Slices slices{};
  int weight = 0;  // the sum over all neighbours that have one
  static constexpr int kSiblings = 15, kFar = 40, kOuter = 34;  // in 3D these are all

  /// What a positive neighbour adds to the log-odds of a positive sign, in units of 1/kOne; rounded
  /// from logistic regressions over volumes of all kinds. For a corner, a vertex across on a single
  /// axis or on several axes, a sibling one step away, a far vertex, and an outer vertex, which
  /// distinguishes a bend from a slope.
  static constexpr int kOne = 32, kCorner = 32, kBeside = 44, kAcross = 8, kSibling = 8,
                       kFarOne = 1, kOuterOne = -4;

  /// What slices sum up: the first kDiamondBits signs of the diamond, as many as the largest
  /// diamond in 3D has; how many of the corners and of the vertices across are positive; and the
  /// weight of the positive vertices within one step.
  struct DiamondSum {
    unsigned diamond, corners, across;
    int weight;
  };
  static constexpr int kDiamondBits = 10, kCountBits = 5;
  /// Splits the sum that RowPacks::diamond() returns.
  static constexpr DiamondSum unpacked(uint32_t sum) {
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

  /// By the set of new axes. Computed once, at run time: as constants the tables would be a large
  /// part of a small decoder.
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
  int farCount_ = 0, outerCount_ = 0;
  std::array<std::array<int, D>, kMost> offsets_{};  // of the diamond's vertices

  constexpr void slice() {
    for (int i = 0; i < diamondCount(); ++i) {
      int axes = 0;
      for (const int d : offsets_[i]) axes += d != 0 ? 1 : 0;
      const bool corner = i < cornerCount;
      const uint32_t sign = i < kDiamondBits ? 1u << i : 0u,
                     count = 1u << (corner ? kDiamondBits : kDiamondBits + kCountBits);
      addToSlices(offsets_[i], sign | count, corner ? kCorner : axes == 1 ? kBeside : kAcross);
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
    NeighbourOffset step;
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
      offsets_[cornerCount + acrossCount] = d;
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
      if (outerCount_++ >= kOuter) return;
      outerMask.add(d);
      weight += kOuterOne;
    } else if (listed) {
      siblingMask.add(d);
    } else if (!sibling && farCount_ < kFar) {
      farMask.add(d);
      weight += kFarOne;
      ++farCount_;
    }
  }
};

}  // namespace isostar
