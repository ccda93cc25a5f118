// A scalar predicted by least squares from those around it, for the magnitude refinement passes
// (§5.3).
#pragma once

#include <bit>
#include <optional>
#include <utility>

#include "estimate/fit_window.h"
#include "util/reciprocal.h"

namespace isostar {

/// The value at a vertex of the linear function that fits its known neighbours best, along the axes
/// and across two of them. Each neighbour is weighted by how well it is known and how far away it
/// is. The second value assumes that the field has the curvature found around here.
template <int D>
struct LocalFit {
  /// Magnitudes without and with curvature, in the window's scale.
  int32_t linear = 0, curved = 0;
  int known = 0;  // how many neighbours are known; 0 if they are too few for a fit

  /// Fits vertex x in row r. `positive`: the vertex's sign.
  static LocalFit of(const FitWindow<D>& window, std::size_t r, int x, bool positive) {
    Sums sums;
    sums.add(window, r, x);
    if (sums.known <= D) return {};
    const auto center = sums.solve();
    if (!center) return {};
    const auto magnitude = [&](int64_t value) {
      return static_cast<int32_t>(
          std::clamp<int64_t>(positive ? value : -value, 0, 2 * FitWindow<D>::kMost));
    };
    return {magnitude((*center)[0]), magnitude((*center)[1]), sums.known};
  }

 private:
  /// The normal equations of value + slope · offset: unknown 0 is the value at the vertex, unknown
  /// a + 1 the slope along axis a.
  struct Sums {
    static constexpr int kUnknowns = D + 1;
    std::array<std::array<int32_t, kUnknowns>, kUnknowns> matrix{};  // its lower half
    std::array<int32_t, kUnknowns> rightSide{}, bends{};
    int known = 0;

    void add(const FitWindow<D>& window, std::size_t r, int x) {
      const int32_t* values = window.values(r, x);
      const uint8_t* weights = window.weights(r, x);
      const auto& bend = window.bends(r, x);
      [&]<std::size_t... N>(std::index_sequence<N...>) {
        (addPair<N>(weights, values, bend[N]), ...);
      }
      (std::make_index_sequence<Direction<D>::kCount>());
    }

    /// The weight of neighbours across two axes, whose squared distance is twice as large: a
    /// quarter, rounded up so that it is 0 only if `weight` is.
    static int32_t quarter(int32_t weight) { return (weight + 3) >> 2; }

    /// Adds the neighbours in one direction, which is a constant because this is the innermost
    /// loop.
    template <std::size_t N>
    void addPair(const uint8_t* weights, const int32_t* values, int32_t bend) {
      constexpr Direction<D> kDirection = Direction<D>::all()[N];
      constexpr int kOffset = kDirection.offset, kSecond = kDirection.second + 1;
      const auto weight = [](int32_t beside) { return kSecond == 0 ? beside : quarter(beside); };
      const int32_t after = weight(weights[kOffset]), before = weight(weights[-kOffset]);
      known += (after != 0 ? 1 : 0) + (before != 0 ? 1 : 0);
      const int32_t sum = after + before, difference = after - before;
      const int32_t weightedAfter = after * values[kOffset],
                    weightedBefore = before * values[-kOffset];
      const auto line = [&](int unknown, int sign) {
        matrix[unknown][0] += sign * difference;
        matrix[unknown][unknown] += sum;
        rightSide[unknown] += sign * (weightedAfter - weightedBefore);
        bends[unknown] += sign * difference * bend;
      };
      matrix[0][0] += sum;
      rightSide[0] += weightedAfter + weightedBefore;
      bends[0] += sum * bend;
      line(kDirection.first + 1, 1);
      if constexpr (kSecond != 0) {
        line(kSecond, kDirection.side);
        matrix[kSecond][kDirection.first + 1] += kDirection.side * sum;
      }
    }

    /// The value at the vertex, first from the neighbours' values, then with the curvature
    /// subtracted; nothing if the neighbours do not determine it. Gaussian elimination in units of
    /// 1/256.
    [[nodiscard]] std::optional<std::array<int64_t, 2>> solve() const {
      constexpr int kBits = 8, kFactorBits = 14;
      std::array<std::array<int64_t, kUnknowns>, kUnknowns> m{};
      std::array<std::array<int64_t, kUnknowns>, 2> right{};
      for (int q = 0; q < kUnknowns; ++q) {
        for (int p = 0; p <= q; ++p) m[q][p] = int64_t{matrix[q][p]} << kBits;
        // Keeps slopes bounded that the neighbours do not determine.
        if (q > 0) m[q][q] += matrix[0][0] / 4 + 1;
        right[0][q] = rightSide[q];
        right[1][q] = int64_t{rightSide[q]} - bends[q];
      }
      for (int p = kUnknowns - 1; p > 0; --p) {
        const int64_t inverse = inverseOf(m[p][p]);
        for (int q = 0; q < p; ++q) {
          const int64_t factor = m[p][q] * inverse >> (31 - kFactorBits);
          for (int s = 0; s <= q; ++s) m[q][s] -= factor * m[p][s] >> kFactorBits;
          for (auto& side : right) side[q] -= factor * side[p] >> kFactorBits;
        }
      }
      if (m[0][0] <= matrix[0][0]) return std::nullopt;
      const int64_t inverse = inverseOf(m[0][0]);
      return std::array<int64_t, 2>{right[0][0] * inverse >> (31 - kBits),
                                    right[1][0] * inverse >> (31 - kBits)};
    }

    /// 2^31 / n with an error of at most a part in 500: a division would take longer than all the
    /// rest.
    static int64_t inverseOf(int64_t n) {
      const auto positive = static_cast<uint32_t>(std::max<int64_t>(n, 1));
      const int empty = std::countl_zero(positive);
      return (reciprocalOfMiddle(positive << empty >> 23) << 8) >> (31 - empty);
    }
  };
};

}  // namespace isostar
