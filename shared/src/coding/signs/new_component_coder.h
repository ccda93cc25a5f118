// New components (§5.2): vertices whose deduced sign is wrong.
#pragma once

#include "coding/exchange/exchange.h"
#include "grid/new_vertex_rows.h"

namespace isostar {

/// Localizes mispredicted signs: the traversal goes by group of quiet bricks and by brick, this
/// class by row and vertex. A brick is quiet if the surface, as coded so far, does not touch it (it
/// is not active): all its signs are the same.
template <int D>
class NewComponentCoder {
 public:
  using Row = typename NewVertexRows<D>::Row;
  using Bits = typename NewVertexRows<D>::Bits;

  /// Codes whether any quiet brick of a group, brick indices `first` … `end` - 1, has a new
  /// component. Without quiet bricks there is no decision, and the result is false.
  template <SignExchange Exchange>
  bool codeGroup(Exchange& exchange, const Signs<D>& signs, const std::vector<uint8_t>& active,
                 NewVertexRows<D>& rows, std::size_t first, std::size_t end, int newAxisCount) {
    bool any = false, quiet = false;
    for (std::size_t brickIndex = first; brickIndex < end; ++brickIndex) {
      if (active[brickIndex] != 0) continue;
      quiet = true;
      any = any || differs(exchange, signs, rows, brickIndex, newAxisCount);
    }
    return quiet && groupFlag_[newAxisCount].bit(exchange.coder(), any);
  }
  template <SignExchange Exchange>
  bool codeQuietBrick(Exchange& exchange, const Signs<D>& signs, NewVertexRows<D>& rows,
                      std::size_t brickIndex, int newAxisCount) {
    return quietFlag_[newAxisCount].bit(exchange.coder(),
                                        differs(exchange, signs, rows, brickIndex, newAxisCount));
  }

  /// Codes the new components of an active brick, which rows.enter() has entered. `coded`: how many
  /// of its signs were coded.
  template <SignExchange Exchange>
  void code(Exchange& exchange, std::size_t brickIndex, NewVertexRows<D>& rows, int newAxisCount,
            int coded) {
    if (brickFlag_[newAxisCount][activity(coded)].bit(exchange.coder(),
                                                      any(exchange, brickIndex, rows)))
      codeRows(exchange, brickIndex, rows, coded);
  }

  /// The same for a brick that is known to have some.
  template <SignExchange Exchange>
  void codeRows(Exchange& exchange, std::size_t brickIndex, NewVertexRows<D>& rows, int coded) {
    int recent = 0;  // 0 before the first row that has some, 1 right after one, 2 later
    for (int i = 0; i < rows.count(); ++i) {
      const Row& row = rows.row(i);
      if (row.deduced() == 0) continue;
      const Bits flips = mispredicted(exchange, brickIndex, rows, row);
      const bool any = rowFlag_[activity(coded)][recent].bit(exchange.coder(), flips != 0);
      if (any) codeVertices(exchange, rows, row, flips);
      recent = any ? 1 : std::min(2 * recent, 2);
    }
  }

 private:
  /// Does a uniform brick have vertices of the class whose sign differs from the brick's?
  template <SignExchange Exchange>
  static bool differs(Exchange& exchange, const Signs<D>& signs, NewVertexRows<D>& rows,
                      std::size_t brickIndex, int newAxisCount) {
    if (!exchange.varies(brickIndex, signs.slot(brickIndex))) return false;
    rows.find(signs.lattice(), signs.table().brick(brickIndex), newAxisCount);
    const uint32_t uniform = signs.slot(brickIndex) == Signs<D>::kPositive ? 0xFF : 0;
    uint32_t difference = 0;
    for (int i = 0; i < rows.count(); ++i)
      difference |= (exchange.row(brickIndex, rows.row(i).brick) ^ uniform) & rows.row(i).members;
    return difference != 0;
  }

  /// A context: how many signs were coded in the brick.
  static int activity(int coded) {
    return coded == 0 ? 0 : coded < 6 ? 1 : coded < 16 ? 2 : coded < 48 ? 3 : 4;
  }

  template <SignExchange Exchange>
  static Bits mispredicted(Exchange& exchange, std::size_t brickIndex, const NewVertexRows<D>& rows,
                           const Row& row) {
    return (exchange.row(brickIndex, row.brick) ^ *rows.signs(row) >> Window<D>::kHalo) &
           row.deduced();
  }

  template <SignExchange Exchange>
  static bool any(Exchange& exchange, std::size_t brickIndex, const NewVertexRows<D>& rows) {
    Bits any = 0;
    for (int i = 0; i < rows.count(); ++i)
      any |= mispredicted(exchange, brickIndex, rows, rows.row(i));
    return any != 0;
  }

  /// For a row that has some: if all but its last candidate are correct, the last one is not, and
  /// needs no decision.
  template <SignExchange Exchange>
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
  std::array<BitModel, 2> vertexFlag_;  // by whether the row already has one
};

}  // namespace isostar
