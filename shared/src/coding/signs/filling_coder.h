// The reverse of welds (§4.3): the absent vertices of an octave come back, and their signs are
// told.
#pragma once

#include "coding/signs/sign_coder.h"

namespace isostar {

template <int D>
class FillingCoder {
 public:
  /// Those that are fresh on `dimension` axes, D first: all coarser ones are there by now, and a
  /// fresh one has its lower corner's sign for now. No component first appears here, or its
  /// vertices would not be absent.
  template <SignExchange Exchange>
  ISOSTAR_COLD void code(Exchange& exchange, Signs<D>& signs, int dimension,
                         const Signs<D>& absent) {
    for (std::size_t brickIndex = 0;
         brickIndex < signs.table().total() && exchange.charge(signs.memory()); ++brickIndex) {
      if (absent.slot(brickIndex) == Signs<D>::kNegative) continue;
      rows_.enter(signs, nullptr, brickIndex, dimension);
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
