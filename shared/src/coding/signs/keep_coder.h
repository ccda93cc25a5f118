// Keep or Refine (§5.1, §5.2): which crossing cells of an adaptive mesh's level are kept.
#pragma once

#include "coding/exchange/exchange.h"
#include "grid/new_vertex_rows.h"

namespace isostar {

/// A cell is kept if its centre is absent. This is coded for each centre whose diamond has both
/// signs, in context of how many centres around are absent.
template <int D>
class KeepCoder {
 public:
  /// For the brick that rows.enter() has entered, in the class of centres (D new axes).
  template <KeepExchange Exchange>
  void code(Exchange& exchange, std::size_t brickIndex, NewVertexRows<D>& rows) {
    for (int i = 0; i < rows.openCount(); ++i) {
      auto& row = rows.open(i);
      const auto& n = neighbourhoods_[row.newAxes];
      const uint32_t actual = exchange.keptRow(brickIndex, row.brick);
      uint16_t& absent = *rows.absent(row);
      for (uint32_t open = row.open; open != 0; open &= open - 1) {
        const int x = std::countr_zero(open), at = x + Window<D>::kHalo;
        const auto packs = RowPacks<D>::around(&absent);
        const unsigned siblings = packs.count(n.siblingMask, at),
                       far = packs.count(n.outerMask, at);
        BitModel& probability = models_[std::min(siblings, 7u) * 4 + (far == 0   ? 0
                                                                      : far < 4  ? 1
                                                                      : far < 12 ? 2
                                                                                 : 3)];
        if (!probability.bit(exchange.coder(), (actual >> x & 1) != 0)) continue;
        absent = static_cast<uint16_t>(absent | 1u << at);
        row.absent = static_cast<uint8_t>(row.absent | 1u << x);
      }
      row.open = static_cast<uint8_t>(row.open & ~row.absent);
    }
  }

 private:
  const typename Neighbourhood<D>::All& neighbourhoods_ = Neighbourhood<D>::all();
  std::array<BitModel, 32> models_;
};

}  // namespace isostar
