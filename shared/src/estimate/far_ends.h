// What the far ends of a vertex's crossed edges say about its own scalar: must it be known better?
// (§5.3)
#pragma once

#include "scalars/scalar_window.h"

namespace isostar {

/// A crossing lies at |a| / (|a| + |b|) on its edge: |b| decides how far an interval of |a| can
/// move it.
template <int D>
class FarEnds {
 public:
  /// How far a crossing may move along an edge of the RBMT, in 1/65536 of it, by the set of axes
  /// that the edge runs along. The last, the cell's diagonal, is 0 where diagonals do not count.
  using Allowed = std::array<uint32_t, (1u << D)>;

  /// Of a brick, as Scalars keep it: sizes are scaled so that products fit.
  void setGradient(int gradient) { scale_ = std::max(0, gradient / 4 - 17); }

  /// Of vertex x of row r, where their scalars are known.
  void find(const ScalarWindow<D>& window, std::size_t r, int x, bool mine,
            const Allowed& allowed) {
    const int32_t* here = &window.value[ScalarWindow<D>::index(r, x)];
    std::size_t count = 0;
    forEachAxis<D>([&](auto a) {
      count = add(here[-ScalarWindow<D>::stride(a)], mine, allowed[std::size_t{1} << a], count);
      count = add(here[ScalarWindow<D>::stride(a)], mine, allowed[std::size_t{1} << a], count);
    });
    if (allowed.back() != 0)
      count = findDiagonals(here, mine, Tube<D>::parity(r, x), allowed, count);
    for (std::size_t i = 0; i < count; ++i) ends_[i].size = scaled(ends_[i].size);
    count_ = count;
  }

  /// May an interval of `width` quanta around `middle` half quanta move a crossing on one of the
  /// edges by more than allowed? Half of it times |b| / (|a| + |b|)² is how far the crossing moves,
  /// to first order; towards a small end of the interval it is more, and `strict` counts that.
  [[nodiscard]] bool move(uint32_t middle, uint32_t width, bool strict) const {
    const uint64_t size = scaled(middle), nearer = strict ? width >> scale_ : 0;
    const uint64_t reach = std::min(uint64_t{width} << 17 >> scale_,
                                    uint64_t{1} << 41);  // wider than that moves anything
    for (std::size_t i = 0; i < count_; ++i) {
      const uint64_t total = ends_[i].size + size;
      if (ends_[i].size * reach > ends_[i].allowed * total * (total - nearer)) return true;
    }
    return false;
  }

 private:
  struct End {
    uint32_t size;  // of its scalar, half quanta, scaled
    uint32_t allowed;
  };
  static constexpr uint32_t kMostSize = 1u << 22;

  std::size_t findDiagonals(const int32_t* here, bool mine, unsigned parity, const Allowed& allowed,
                            std::size_t count) {
    Coordinates<D> d;
    d.fill(-1);
    for (std::size_t n = 0; n < power(3, D); ++n) {
      unsigned axes = 0;
      int offset = 0;
      for (int a = 0; a < D; ++a) {
        axes |= d[a] != 0 ? 1u << a : 0u;
        offset += d[a] * ScalarWindow<D>::stride(a);
      }
      // Ends are even on all axes of the diagonal, or odd on all.
      if (!std::has_single_bit(axes) && axes != 0 &&
          ((parity & axes) == 0 || (parity & axes) == axes))
        count = add(here[offset], mine, allowed[axes], count);
      for (int a = 0; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
    return count;
  }

  /// Written always, counted where it is one: a branch less that nobody could predict.
  std::size_t add(int32_t value, bool mine, uint32_t allowed, std::size_t count) {
    const auto size = static_cast<uint32_t>(mine ? -int64_t{value} : value);
    ends_[count] = {size, allowed};
    return count + (size - 1 < 0x7FFFFFFFu ? 1 : 0);  // neither is an unknown one
  }

  /// To 22 bits for sizes up to 16 gradients, so that products fit.
  [[nodiscard]] uint32_t scaled(uint32_t size) const {
    return std::clamp<uint32_t>(size >> scale_, 1, kMostSize);
  }

  int scale_ = 0;
  std::array<End, power(3, D) + 1> ends_;
  std::size_t count_ = 0;
};

}  // namespace isostar
