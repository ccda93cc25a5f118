// The far ends of a vertex's crossing edges: do they require that its scalar be known better?
// (§5.3)
#pragma once

#include "scalars/scalar_window.h"

namespace isostar {

/// A crossing lies at |a| / (|a| + |b|) of its edge, so |b| determines how far an interval of |a|
/// can move it.
template <int D>
class FarEnds {
 public:
  /// How far a crossing may move along an edge of the RBMT, in 1/65536 of the edge, by the set of
  /// axes along which the edge runs. The last entry, the cell's diagonal, is 0 if diagonals do not
  /// count, and 1 if they do, but nothing may move.
  using Allowed = std::array<uint32_t, (1u << D)>;

  /// Sets the brick's gradient, as Scalars store it: magnitudes are scaled by it so that products
  /// fit 64 bits.
  void setGradient(int gradient) { scale_ = std::max(0, gradient / 4 - 17); }

  /// Finds the far ends of vertex x of row r whose scalars are known. `mine`: the vertex's sign.
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

  /// As long as so many decisions does find() take, about.
  [[nodiscard]] static uint64_t decisionsToFind(const Allowed& allowed) {
    return allowed.back() == 0 ? 1 : power(3, D) / 8;
  }

  /// May an interval of `width` quantization steps around `middle` half quantization steps move a
  /// crossing on one of the edges by more than allowed, from one end of the interval to the other?
  /// To first order that is the interval times |b| / (|a| + |b|)². Towards a small end of the
  /// interval it is more, which `strict` takes into account.
  [[nodiscard]] bool move(uint32_t middle, uint32_t width, bool strict) const {
    const uint64_t size = scaled(middle), nearer = strict ? width >> scale_ : 0;
    const uint64_t reach = std::min(uint64_t{width} << 17 >> scale_,
                                    uint64_t{1} << 41);  // a wider one moves any crossing
    for (std::size_t i = 0; i < count_; ++i) {
      const uint64_t total = ends_[i].size + size;
      if (ends_[i].size * reach > ends_[i].allowed * total * (total - nearer)) return true;
    }
    return false;
  }

 private:
  struct End {
    uint32_t size;  // of its scalar, in half quantization steps, scaled
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
      // A diagonal's ends are even on all its axes, or odd on all.
      if (!std::has_single_bit(axes) && axes != 0 &&
          ((parity & axes) == 0 || (parity & axes) == axes))
        count = add(here[offset], mine, allowed[axes] == 1 ? 0 : allowed[axes], count);
      for (int a = 0; a < D && ++d[a] == 2; ++a) d[a] = -1;
    }
    return count;
  }

  /// Always writes the entry, but counts it only if it is a far end: this saves an unpredictable
  /// branch.
  std::size_t add(int32_t value, bool mine, uint32_t allowed, std::size_t count) {
    const auto size = static_cast<uint32_t>(mine ? -int64_t{value} : value);
    ends_[count] = {size, allowed};
    return count + (size - 1 < 0x7FFFFFFFu ? 1 : 0);  // neither is an unknown one
  }

  /// Scaled to 22 bits for scalars up to 16 gradients, so that products fit.
  [[nodiscard]] uint32_t scaled(uint32_t size) const {
    return std::clamp<uint32_t>(size >> scale_, 1, kMostSize);
  }

  int scale_ = 0;
  std::array<End, power(3, D) + 1> ends_;
  std::size_t count_ = 0;
};

}  // namespace isostar
