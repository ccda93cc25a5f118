// Z-order: numbers for the places of a box, so that places that lie together have near numbers.
#pragma once

#include <algorithm>
#include <cstddef>

#include "grid/lattice.h"
#include "util/cold_path.h"

namespace isostar {

/// Halves the least cube that holds the box and has a power of two as its side along the last axis,
/// then along the axes before, and so on in each half. The lower half is first; places beyond the
/// box have no numbers.
template <int D>
class ZOrder {
 public:
  /// `count`: places on each axis, at least 1.
  explicit ZOrder(const Coordinates<D>& count) : count_(count) {
    while (side_ < *std::max_element(count.begin(), count.end())) side_ *= 2;
  }

  [[nodiscard]] std::size_t total() const { return product(count_); }
  [[nodiscard]] ISOSTAR_COLD std::size_t number(const Coordinates<D>& place) const {
    std::size_t number = 0;
    descend([&](int axis, int32_t middle, std::size_t below) {
      if (place[axis] < middle) return false;
      number += below;
      return true;
    });
    return number;
  }
  /// The place with a number below total().
  [[nodiscard]] ISOSTAR_COLD Coordinates<D> place(std::size_t number) const {
    return descend([&](int, int32_t, std::size_t below) {
      if (number < below) return false;
      number -= below;
      return true;
    });
  }

 private:
  [[nodiscard]] static std::size_t product(const Coordinates<D>& size) {
    std::size_t product = 1;
    for (const int32_t n : size) product *= static_cast<std::size_t>(n);
    return product;
  }
  /// Goes down to one place. isAbove(axis, first place of the upper half, places in the lower half)
  /// chooses between halves that both have places.
  template <class IsAbove>
  Coordinates<D> descend(IsAbove isAbove) const {
    Coordinates<D> low{}, size = count_;
    for (int32_t half = side_ / 2; half > 0; half /= 2) {
      for (int a = D - 1; a >= 0; --a) {
        if (size[a] <= half) continue;
        Coordinates<D> below = size;
        below[a] = half;
        if (isAbove(a, low[a] + half, product(below))) {
          low[a] += half;
          size[a] -= half;
        } else {
          size = below;
        }
      }
    }
    return low;
  }

  Coordinates<D> count_;
  int32_t side_ = 1;  // of the cube
};

}  // namespace isostar
