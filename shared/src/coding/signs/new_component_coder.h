// Components of the surface that first appear (§5.2): vertices whose deduced sign is false.
#pragma once

#include "coding/exchange/exchange.h"
#include "grid/new_vertex_rows.h"

namespace isostar {

/// Localizes exceptions to the deduction of signs: by group of quiet bricks and brick, which the traversal goes through,
/// then by row and vertex.
template <int D>
class ExceptionCoder {
 public:
  using Row = typename FreshRows<D>::Row;
  using Bits = typename FreshRows<D>::Bits;

  /// Has any brick of a group without a surface some?
  template <class Coder>
  bool inGroup(Coder& coder, int dimension, bool truth) {
    return groupFlag_[dimension].bit(coder, truth);
  }
  template <class Coder>
  bool inQuietBrick(Coder& coder, int dimension, bool truth) {
    return quietFlag_[dimension].bit(coder, truth);
  }

  /// Those of a brick near the surface, that has been entered; `told`: how many of its signs have been.
  template <class Exchange>
  void tell(Exchange& ask, std::size_t place, FreshRows<D>& rows, int dimension, int told) {
    if (brickFlag_[dimension][activity(told)].bit(ask.coder(), any(ask, place, rows))) tellRows(ask, place, rows, told);
  }

  /// Of a brick that has some.
  template <class Exchange>
  void tellRows(Exchange& ask, std::size_t place, FreshRows<D>& rows, int told) {
    int lately = 0;  // 0 before the first row that has some, 1 right after one, 2 later
    for (int i = 0; i < rows.count(); ++i) {
      const Row& row = rows.row(i);
      if (row.deduced() == 0) continue;
      const Bits flips = exceptions(ask, place, rows, row);
      const bool any = rowFlag_[activity(told)][lately].bit(ask.coder(), flips != 0);
      if (any) tellVertices(ask, rows, row, flips);
      lately = any ? 1 : std::min(2 * lately, 2);
    }
  }

 private:
  /// How busy a brick is.
  static int activity(int told) { return told == 0 ? 0 : told < 6 ? 1 : told < 16 ? 2 : told < 48 ? 3 : 4; }

  template <class Exchange>
  static Bits exceptions(Exchange& ask, std::size_t place, const FreshRows<D>& rows, const Row& row) {
    return (ask.row(place, row.brick) ^ *rows.signs(row) >> Window<D>::kHalo) & row.deduced();
  }

  template <class Exchange>
  static bool any(Exchange& ask, std::size_t place, const FreshRows<D>& rows) {
    Bits any = 0;
    for (int i = 0; i < rows.count(); ++i) any |= exceptions(ask, place, rows, rows.row(i));
    return any != 0;
  }

  /// Those of a row that has some: if all but the last one are none, it is one.
  template <class Exchange>
  void tellVertices(Exchange& ask, FreshRows<D>& rows, const Row& row, Bits flips) {
    bool any = false;
    for (Bits deduced = row.deduced(); deduced != 0; deduced &= deduced - 1) {
      const int x = std::countr_zero(deduced);
      const bool sure = !any && (deduced & (deduced - 1)) == 0;
      if (!sure && !vertexFlag_[any ? 1 : 0].bit(ask.coder(), (flips >> x & 1) != 0)) continue;
      *rows.signs(row) ^= static_cast<uint16_t>(1u << (x + Window<D>::kHalo));
      any = true;
    }
    rows.setChanged(any);
  }

  std::array<Chance, D + 1> groupFlag_, quietFlag_;          // by class
  std::array<std::array<Chance, 5>, D + 1> brickFlag_;       // by class and activity
  std::array<std::array<Chance, 3>, 5> rowFlag_;
  std::array<Chance, 2> vertexFlag_;  // by whether the row had one before
};

}  // namespace isostar
