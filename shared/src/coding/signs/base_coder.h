// The base level (§5.1, uniform): each component is localized, then the tube is traversed through
// its gates, depth first.
#pragma once

#include <optional>
#include <vector>

#include "coding/exchange/exchange.h"
#include "grid/simplex.h"
#include "util/cold_path.h"

namespace isostar {

/// Codes the signs of the base level. The sign of a vertex of the tube is coded once, when the
/// traversal first reaches it. All other signs are deduced, since those vertices lie on one side of
/// the tube.
template <int D>
class BaseCoder {
 public:
  template <BaseExchange<D> Exchange>
  ISOSTAR_COLD void code(Exchange& exchange, Signs<D>& signs) {
    const auto& lattice = signs.lattice();
    known_.assign(lattice.vertices(), kUnknown);
    visited_.assign(Simplex<D>::count(lattice), 0);
    bool any = false;
    std::optional<Simplex<D>> seed = exchange.nextSeed(lattice, visited_);
    while (!visited_.empty() && !exchange.exhausted() &&
           another_.bit(exchange.coder(), seed.has_value())) {
      any = true;
      component(exchange, lattice, localize(exchange, lattice, seed.value_or(Simplex<D>{})));
      seed = exchange.nextSeed(lattice, visited_);
    }
    if (!any) known_[0] = mark(uniform_.bit(exchange.coder(), exchange.positive(Coordinates<D>{})));
    deduce(lattice);
    write(signs);
  }

 private:
  enum : uint8_t { kUnknown, kNegative, kPositive };
  static uint8_t mark(bool positive) { return positive ? kPositive : kNegative; }

  static std::size_t index(const Lattice<D>& lattice, const Coordinates<D>& v) {
    std::size_t at = 0;
    for (int a = D - 1; a >= 0; --a)
      at = at * static_cast<std::size_t>(lattice.last[a] + 1) + static_cast<std::size_t>(v[a]);
    return at;
  }

  /// Codes the path to a component's first simplex. The hierarchy is a binary partition of space:
  /// one Left/Right decision halves the box across its longest side until one cell is left; further
  /// decisions halve the list of its simplices. Empty sides need no decision.
  template <BaseExchange<D> Exchange>
  Simplex<D> localize(Exchange& exchange, const Lattice<D>& lattice, const Simplex<D>& actual) {
    Coordinates<D> low{}, high = lattice.last;  // cells low … high - 1
    const auto cell = actual.cell();
    for (;;) {
      int longest = 0;
      for (int a = 1; a < D; ++a) {
        if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
      }
      if (high[longest] - low[longest] <= 1) break;
      const int32_t middle = low[longest] + (high[longest] - low[longest]) / 2;
      (side_.bit(exchange.coder(), cell[longest] >= middle) ? low : high)[longest] = middle;
    }
    uint32_t first = 0, count = Simplex<D>::perCell();
    const uint32_t rank = actual.rank();
    while (count > 1) {
      const uint32_t half = count / 2;
      const bool right = side_.bit(exchange.coder(), rank >= first + half);
      first += right ? half : 0;
      count = right ? count - half : half;
    }
    return Simplex<D>::inCell(low, first);
  }

  template <BaseExchange<D> Exchange>
  void component(Exchange& exchange, const Lattice<D>& lattice, const Simplex<D>& seed) {
    for (int i = 0; i <= D; ++i) settle(exchange, lattice, seed.vertex(i), seedModel_);
    visited_[seed.index(lattice)] = 1;
    stack_.assign(1, seed);
    while (!stack_.empty() && !exchange.exhausted()) {
      if (!step(exchange, lattice, stack_.back())) stack_.pop_back();
    }
  }

  /// Moves on through the first valid gate: a crossing face that leads to a simplex not yet
  /// visited. False if there is none.
  template <BaseExchange<D> Exchange>
  bool step(Exchange& exchange, const Lattice<D>& lattice, const Simplex<D> from) {
    std::array<bool, D + 1> positive;
    int positives = 0;
    for (int i = 0; i <= D; ++i) {
      positive[i] = known_[index(lattice, from.vertex(i))] == kPositive;
      positives += positive[i];
    }
    for (int i = 0; i <= D; ++i) {
      const int inGate = positives - positive[i];
      if (inGate == 0 || inGate == D) continue;
      const auto next = from.across(i, lattice);
      if (!next || visited_[next->index(lattice)] != 0) continue;
      visited_[next->index(lattice)] = 1;
      settle(exchange, lattice, next->vertex(i),
             gateModel_[static_cast<std::size_t>(inGate)][positive[i]]);
      stack_.push_back(*next);
      return true;
    }
    return false;
  }

  template <BaseExchange<D> Exchange>
  void settle(Exchange& exchange, const Lattice<D>& lattice, const Coordinates<D>& v,
              BitModel& model) {
    uint8_t& known = known_[index(lattice, v)];
    if (known == kUnknown) known = mark(model.bit(exchange.coder(), exchange.positive(v)));
  }

  /// A vertex outside the tube has the sign of its neighbours.
  void deduce(const Lattice<D>& lattice) {
    std::vector<Coordinates<D>> front;
    forVertices(lattice, [&](const Coordinates<D>& v) {
      if (known_[index(lattice, v)] != kUnknown) front.push_back(v);
    });
    for (std::size_t i = 0; i < front.size(); ++i) {
      const uint8_t sign = known_[index(lattice, front[i])];
      for (int a = 0; a < D; ++a) {
        for (int32_t side = -1; side <= 1; side += 2) {
          Coordinates<D> next = front[i];
          next[a] += side;
          if (next[a] < 0 || next[a] > lattice.last[a] || known_[index(lattice, next)] != kUnknown)
            continue;
          known_[index(lattice, next)] = sign;
          front.push_back(next);
        }
      }
    }
  }

  void write(Signs<D>& signs) {
    forVertices(signs.lattice(), [&](const Coordinates<D>& v) {
      signs.set(v, known_[index(signs.lattice(), v)] == kPositive);
    });
  }

  template <class Visit>
  static void forVertices(const Lattice<D>& lattice, Visit visit) {
    for (Coordinates<D> v{};;) {
      visit(v);
      int a = 0;
      for (; a < D && ++v[a] > lattice.last[a]; ++a) v[a] = 0;
      if (a == D) return;
    }
  }

  std::vector<uint8_t> known_;
  std::vector<uint8_t> visited_;  // 1 for each simplex that has been reached, else 0
  std::vector<Simplex<D>> stack_;
  BitModel another_, uniform_, side_, seedModel_;
  std::array<std::array<BitModel, 2>, D + 1> gateModel_;
};

}  // namespace isostar
