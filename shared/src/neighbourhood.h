// What surrounds a new vertex of the RBMT: its diamond, and the siblings that are told before it.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>

#include "window.h"

namespace isostar {

/// A neighbour in a Window: rows further and bits further.
struct Step {
  int16_t rows = 0;
  int8_t bits = 0;
};

/// The neighbours of a vertex that is fresh on the axes of a set O. Splitting the diagonal of the cube or face that
/// spans O creates the vertex; its diamond (all simplices around that edge) has the corners v + {±1}^O and, across the
/// other axes N, v + {-1,0,1}^N without v. After K. Weiss, L. De Floriani, Diamond hierarchies of arbitrary dimension (2009).
template <int D>
struct Neighbourhood {
  static constexpr int kMost = static_cast<int>(power(3, D)) + 5;
  std::array<Step, kMost> diamond{};   // the corners, then those across
  std::array<Step, kMost> siblings{};  // of the same class, earlier in the order of rows; nearest first
  std::array<Step, kMost> far{};       // of earlier classes outside the diamond; nearest first
  int cornerCount = 0, acrossCount = 0, siblingCount = 0, farCount = 0;

  [[nodiscard]] constexpr int diamondCount() const { return cornerCount + acrossCount; }

  constexpr Neighbourhood() = default;
  constexpr explicit Neighbourhood(unsigned fresh) {
    collect(fresh, true);
    collect(fresh, false);
  }

 private:
  constexpr void collect(unsigned fresh, bool corners) {
    for (int distance = 1; distance <= 2 * D + 2; ++distance) {
      std::array<int, D> d{};
      d.fill(-2);
      for (std::size_t n = power(5, D); n > 0; --n) {
        int squares = 0;
        for (int a = 0; a < D; ++a) squares += d[a] * d[a];
        if (squares == distance) place(fresh, d, corners);
        for (int a = 0; a < D && ++d[a] == 3; ++a) d[a] = -2;
      }
    }
  }

  constexpr void place(unsigned fresh, const std::array<int, D>& d, bool corners) {
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
      if (corner == corners) diamond[corners ? cornerCount++ : cornerCount + acrossCount++] = step;
    } else if (corners && other == mine && earlier && siblingCount < kMost) {
      siblings[siblingCount++] = step;
    } else if (corners && (other == 0 || other > mine) && farCount < kMost) {
      far[farCount++] = step;
    }
  }
};

}  // namespace isostar
