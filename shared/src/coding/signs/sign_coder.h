// The signs of new vertices whose diamond has both signs (§5.2), coded in context of the signs
// around.
#pragma once

#include "coding/exchange/exchange.h"
#include "grid/new_vertex_rows.h"
#include "util/cold_path.h"

namespace isostar {

/// Mixes three contexts and an estimate: the exact signs of the diamond, counts of its signs,
/// counts of signs further away, and a weighted sum of all signs around.
template <int D>
class SignCoder {
 public:
  using Row = typename NewVertexRows<D>::Row;
  using Bits = typename NewVertexRows<D>::Bits;

  ISOSTAR_COLD SignCoder() {
    uint32_t near = 0, counted = 0;
    for (unsigned set = 1; set < kSets; ++set) {
      const auto& n = neighbourhoods_[set];
      // The first set with that many axes; they share all tables but near_.
      const unsigned first = (1u << std::popcount(set)) - 1;
      const int diamondBits = std::min(n.diamondCount(), Nearby::kDiamondBits),
                siblings = std::min(kSiblings, kMostNearBits - diamondBits);
      tables_[set] = {near, set == first ? counted : tables_[first].counted, siblings};
      near += 1u << (diamondBits + siblings);
      if (set == first) counted += static_cast<uint32_t>((n.cornerCount + 1) * (n.acrossCount + 1));
    }
    near_.resize(near);
    counts_.resize(counted << kSiblings);
    wide_.resize(counted << kWideBits);
    weights_.resize(counted, Mixer<kInputs>::initialWeightsWithEstimate());
  }

  /// Codes the open vertices of the brick that rows.enter() has entered. Returns how many there
  /// were.
  template <SignExchange Exchange>
  int code(Exchange& exchange, std::size_t brickIndex, NewVertexRows<D>& rows) {
    int coded = 0;
    for (int i = 0; i < rows.openCount(); ++i)
      coded += codeRow(exchange, brickIndex, rows, rows.open(i));
    return coded;
  }

 private:
  static constexpr int kInputs = 3;
  static constexpr int kMostNearBits = 14, kSiblings = 7, kWideBits = 8;
  static constexpr unsigned kSets = 1u << D;
  using Nearby = Neighbourhood<D>;

  template <SignExchange Exchange>
  int codeRow(Exchange& exchange, std::size_t brickIndex, NewVertexRows<D>& rows, const Row& row) {
    int coded = 0;
    const Bits actual = exchange.row(brickIndex, row.brick);
    uint16_t& signs = *rows.signs(row);
    packs_ = RowPacks<D>::around(&signs);
    const uint16_t before = signs;
    for (Bits open = row.open; open != 0; open &= open - 1, ++coded) {
      const int x = std::countr_zero(open), at = x + Window<D>::kHalo;
      // Without a branch, which would be mispredicted often.
      const unsigned flipped =
          (static_cast<unsigned>(signs) >> at & 1) ^
          (codeSign(exchange, &signs, row.newAxes, at, (actual >> x & 1) != 0) ? 1u : 0u);
      signs = static_cast<uint16_t>(signs ^ flipped << at);
      packs_.flip(flipped, at);
    }
    rows.setChanged(signs != before);
    return coded;
  }

  /// Codes bit `at` of a row in a Window; packs_ holds the rows around it.
  template <SignExchange Exchange>
  bool codeSign(Exchange& exchange, const uint16_t* here, unsigned newAxes, int at, bool actual) {
    const auto& n = neighbourhoods_[newAxes];
    auto gather = [&](const NeighbourOffset* steps, int count) {
      unsigned bits = 0;
      for (int i = 0; i < count; ++i)
        bits = bits << 1 | (static_cast<unsigned>(here[steps[i].rows]) >> (at + steps[i].bits) & 1);
      return bits;
    };
    const auto [diamond, corners, across, nearWeight] =
        Nearby::unpacked(packs_.diamond(n.slices, at));
    const unsigned first = gather(n.siblings.data(), kSiblings);
    const unsigned siblings = packs_.count(n.siblingMask, at), far = packs_.count(n.farMask, at),
                   outer = packs_.count(n.outerMask, at);
    const int weight = nearWeight + static_cast<int>(far) * Nearby::kFarOne +
                       static_cast<int>(outer) * Nearby::kOuterOne;
    const Table& table = tables_[newAxes];
    const unsigned counted =
        table.counted + corners * static_cast<unsigned>(n.acrossCount + 1) + across;
    const std::array<BitModel*, kInputs> contexts{
        &near_[table.near + (diamond << table.siblings | first >> (kSiblings - table.siblings))],
        &counts_[counted << kSiblings | first],
        &wide_[counted << kWideBits | siblings / 2 << 5 | far / 2]};
    // Positive weights minus negative ones, in 1/256 of log-odds.
    const int estimate = (2 * weight - n.weight) * (256 / Nearby::kOne);
    return Mixer<kInputs>::template bit<255, 12>(exchange.coder(), actual, contexts,
                                                 weights_[counted], estimate);
  }

  const typename Nearby::All& neighbourhoods_ = Nearby::all();
  RowPacks<D> packs_;  // around the current row
  /// Where the contexts of a set of new axes begin in the tables.
  struct Table {
    uint32_t near = 0, counted = 0;
    int siblings = 0;  // how many siblings the contexts of near_ include
  };
  std::array<Table, kSets> tables_{};
  std::vector<BitModel> near_, counts_, wide_;
  std::vector<typename Mixer<kInputs>::Weights> weights_;
};

}  // namespace isostar
