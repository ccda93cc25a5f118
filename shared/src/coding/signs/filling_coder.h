// The reverse of welds (§4.3): codes the signs of a level's absent vertices.
#pragma once

#include "coding/signs/sign_coder.h"

namespace isostar {

template <int D>
class FillingCoder {
 public:
  /// Codes the absent vertices with `newAxisCount` new axes; to be called for D first, then down to
  /// 1. All coarser vertices must be there, and absent ones must have the sign of their lower
  /// corner. New components cannot appear here: such vertices are never absent.
  template <SignExchange Exchange>
  ISOSTAR_COLD void code(Exchange& exchange, Signs<D>& signs, int newAxisCount,
                         const Signs<D>& absent) {
    for (std::size_t brickIndex = 0;
         brickIndex < signs.table().total() && exchange.charge(signs.memory()); ++brickIndex) {
      if (absent.slot(brickIndex) == Signs<D>::kNegative) continue;
      exchange.visitBrick();
      rows_.enter(signs, nullptr, brickIndex, newAxisCount);
      for (int i = 0; i < rows_.openCount(); ++i) {
        auto& row = rows_.open(i);
        row.open = static_cast<uint8_t>(row.open & absent.brickAt(brickIndex).rows[row.brick]);
      }
      coder_.code(exchange, brickIndex, rows_);
      if (rows_.changed()) rows_.store(signs, brickIndex);
    }
  }

 private:
  NewVertexRows<D> rows_;
  SignCoder<D> coder_;
};

}  // namespace isostar
