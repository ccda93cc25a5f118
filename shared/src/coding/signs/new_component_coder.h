// Components of the surface that first appear (§5.2): vertices whose deduced sign is false.
#pragma once

#include "coding/exchange/exchange.h"
#include "grid/new_vertex_rows.h"

namespace isostar {

/// Localizes exceptions to the deduction of signs: by group of quiet bricks and brick, which the
/// traversal goes through, then by row and vertex.
template <int D>
class NewComponentCoder {
 public:
  using Row = typename NewVertexRows<D>::Row;
  using Bits = typename NewVertexRows<D>::Bits;

  /// Has any brick of a group without a surface some?
  template <class Coder>
  bool inGroup(Coder& coder, int dimension, bool actual) {
    return groupFlag_[dimension].bit(coder, actual);
  }
  template <class Coder>
  bool inQuietBrick(Coder& coder, int dimension, bool actual) {
    return quietFlag_[dimension].bit(coder, actual);
  }

  /// Those of a brick near the surface, that has been entered; `told`: how many of its signs have
  /// been.
  template <class Exchange>
  void code(Exchange& exchange, std::size_t brickIndex, NewVertexRows<D>& rows, int dimension,
            int coded) {
    if (brickFlag_[dimension][activity(coded)].bit(exchange.coder(),
                                                   any(exchange, brickIndex, rows)))
      codeRows(exchange, brickIndex, rows, coded);
  }

  /// Of a brick that has some.
  template <class Exchange>
  void codeRows(Exchange& exchange, std::size_t brickIndex, NewVertexRows<D>& rows, int coded) {
    int lately = 0;  // 0 before the first row that has some, 1 right after one, 2 later
    for (int i = 0; i < rows.count(); ++i) {
      const Row& row = rows.row(i);
      if (row.deduced() == 0) continue;
      const Bits flips = exceptions(exchange, brickIndex, rows, row);
      const bool any = rowFlag_[activity(coded)][lately].bit(exchange.coder(), flips != 0);
      if (any) codeVertices(exchange, rows, row, flips);
      lately = any ? 1 : std::min(2 * lately, 2);
    }
  }

 private:
  /// How busy a brick is.
  static int activity(int coded) {
    return coded == 0 ? 0 : coded < 6 ? 1 : coded < 16 ? 2 : coded < 48 ? 3 : 4;
  }

  template <class Exchange>
  static Bits exceptions(Exchange& exchange, std::size_t brickIndex, const NewVertexRows<D>& rows,
                         const Row& row) {
    return (exchange.row(brickIndex, row.brick) ^ *rows.signs(row) >> Window<D>::kHalo) &
           row.deduced();
  }

  template <class Exchange>
  static bool any(Exchange& exchange, std::size_t brickIndex, const NewVertexRows<D>& rows) {
    Bits any = 0;
    for (int i = 0; i < rows.count(); ++i)
      any |= exceptions(exchange, brickIndex, rows, rows.row(i));
    return any != 0;
  }

  /// Those of a row that has some: if all but the last one are none, it is one.
  template <class Exchange>
  void codeVertices(Exchange& exchange, NewVertexRows<D>& rows, const Row& row, Bits flips) {
    bool any = false;
    for (Bits deduced = row.deduced(); deduced != 0; deduced &= deduced - 1) {
      const int x = std::countr_zero(deduced);
      const bool sure = !any && (deduced & (deduced - 1)) == 0;
      if (!sure && !vertexFlag_[any ? 1 : 0].bit(exchange.coder(), (flips >> x & 1) != 0)) continue;
      *rows.signs(row) ^= static_cast<uint16_t>(1u << (x + Window<D>::kHalo));
      any = true;
    }
    rows.setChanged(any);
  }

  std::array<BitModel, D + 1> groupFlag_, quietFlag_;     // by class
  std::array<std::array<BitModel, 5>, D + 1> brickFlag_;  // by class and activity
  std::array<std::array<BitModel, 3>, 5> rowFlag_;
  std::array<BitModel, 2> vertexFlag_;  // by whether the row had one before
};

}  // namespace isostar
