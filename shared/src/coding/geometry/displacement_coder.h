// Displacements of cubes of vertices (§5.3), coded before the scalars.
#pragma once

#include "coding/exchange/exchange.h"
#include "entropy/unary.h"
#include "scalars/displacement_window.h"
#include "util/cold_path.h"

namespace isostar {

/// A pass codes one displacement for every cube, so that all parts of the surface come a little
/// nearer before any part comes much nearer. Planes along the grid gain most: the signs around them
/// say nothing about their location.
template <int D>
class DisplacementCoder {
 public:
  ISOSTAR_COLD DisplacementCoder() { weights_.fill(Mixer<kInputs>::initialWeights()); }

  template <DisplacementExchange Exchange>
  void code(Exchange& exchange, const Signs<D>& signs, Displacements<D>& displacements,
            const DisplacementPass& pass, const std::vector<uint8_t>& active) {
    for (std::size_t brickIndex = 0;
         brickIndex < active.size() && exchange.charge(displacements.memory()); ++brickIndex) {
      if (active[brickIndex] != 0) cubes(exchange, signs, displacements, brickIndex, pass);
    }
  }

 private:
  using Values = Displacements<D>;
  static constexpr int kInputs = 4;
  static constexpr int kMost = 4;  // steps in one pass
  static constexpr std::size_t kDecisions = kMost + 1;
  static constexpr int kMeans = 9, kWideMeans = 17, kShares = 4, kTrusts = 4, kWideTrusts = 8;

  template <DisplacementExchange Exchange>
  void cubes(Exchange& exchange, const Signs<D>& signs, Values& displacements,
             std::size_t brickIndex, const DisplacementPass& pass) {
    exchange.visitBrick();
    findMembers(signs, displacements, brickIndex);
    auto& own = displacements.writable(brickIndex);
    window_.load(displacements, signs.table(), signs.table().brick(brickIndex));
    if (pass.log2Side == 1) {
      for (std::size_t block = 0; block < own.size(); ++block) {
        if (!members_[block]) continue;
        const int before = own[block] == Values::kNone ? 0 : own[block];
        move(own, block,
             code(exchange, context(block, 1, pass.step, before, 1),
                  exchange.displacement(brickIndex, block)) *
                 pass.step);
      }
      return;
    }
    const int side = 1 << (pass.log2Side - 1);
    Coordinates<D> first{};
    do {
      cube(exchange, own, brickIndex, first, side, pass.step);
    } while (next(first, side));
  }

  /// The blocks with a positive end of a crossing axis edge. An earlier pass has already found
  /// them.
  ISOSTAR_COLD void findMembers(const Signs<D>& signs, const Values& displacements,
                                std::size_t brickIndex) {
    if (displacements.has(brickIndex)) {
      const auto& own = displacements.at(brickIndex);
      for (std::size_t block = 0; block < own.size(); ++block)
        members_[block] = own[block] != Values::kNone;
      return;
    }
    members_.fill(false);
    tube_.enter(signs, brickIndex, Members::AxisEnds);
    tube_.forEach(true, [&](int, std::size_t r, int x) { members_[Values::block(r, x)] = true; });
  }

  /// Moves to the next cube of a brick; `first` is the block at the cube's lower corner.
  static bool next(Coordinates<D>& first, int side) {
    for (int a = 0; a < D; ++a) {
      first[a] += side;
      if (first[a] < Values::kSide) return true;
      first[a] = 0;
    }
    return false;
  }

  template <class Visit>
  void forMembers(const Coordinates<D>& first, int side, Visit visit) const {
    Coordinates<D> last = first;
    for (int a = 0; a < D; ++a) last[a] += side - 1;
    forEachBetween<D>(first, last, [&](const Coordinates<D>& v) {
      const std::size_t block = Values::blockAt(v);
      if (members_[block]) visit(block);
    });
  }

  /// Contexts of a cube. Means of the differences to its neighbours: below it, where all are coded,
  /// and all around; `wide` ones include neighbours along two axes, for cubes of one block.
  /// `trust`: how many of the neighbours below are known. `share`: how much of the cube the surface
  /// occupies.
  struct Context {
    std::size_t below, around, wideBelow, wideAround, trust, wideTrust, share;
  };
  /// A sum of differences, with its weight.
  struct Differences {
    int sum = 0, count = 0;

    void add(int8_t value, int own, int weight = 1) {
      // Without a branch, which would be mispredicted often.
      weight = value == Values::kNone ? 0 : weight;
      sum += weight * (value - own);
      count += weight;
    }
    [[nodiscard]] Differences with(const Differences& other) const {
      return {sum + other.sum, count + other.count};
    }
    /// Their mean, quantized to `most` contexts, which cover two steps up and down.
    [[nodiscard]] std::size_t mean(int step, int most) const {
      const int half = most / 2, unit = std::max(count, 1) * step;
      const int rounded = (std::abs(sum) * half + unit) / (2 * unit);
      return static_cast<std::size_t>(std::clamp(sum < 0 ? -rounded : rounded, -half, half) + half);
    }
  };

  template <DisplacementExchange Exchange>
  ISOSTAR_COLD void cube(Exchange& exchange, typename Values::Brick& own, std::size_t brickIndex,
                         const Coordinates<D>& first, int side, int step) {
    const std::size_t corner = Values::blockAt(first);
    int members = 0, sum = 0;
    forMembers(first, side, [&](std::size_t block) {
      ++members;
      sum += own[block] == Values::kNone ? 0 : own[block];
    });
    if (members == 0) return;
    const int difference = code(exchange, context(corner, side, step, sum / members, members),
                                exchange.displacement(brickIndex, corner)) *
                           step;
    forMembers(first, side, [&](std::size_t block) { move(own, block, difference); });
  }

  void move(typename Values::Brick& own, std::size_t block, int units) {
    Values::move(own[block], units);
    window_.value[static_cast<std::size_t>(DisplacementWindow<D>::index(block))] = own[block];
  }

  [[nodiscard]] Context context(std::size_t corner, int side, int step, int own,
                                int members) const {
    const int8_t* here =
        &window_.value[static_cast<std::size_t>(DisplacementWindow<D>::index(corner))];
    Differences below, above;
    for (int a = 0; a < D; ++a) {
      below.add(here[-DisplacementWindow<D>::stride(a)], own);
      above.add(here[side * DisplacementWindow<D>::stride(a)], own);
    }
    Differences wideBelow = below, wideAbove = above;
    if (side == 1) {
      wideBelow = wideAbove = {};
      for (const Neighbour& n : kAbove) {
        wideBelow.add(here[-n.offset], own, n.weight);
        wideAbove.add(here[n.offset], own, n.weight);
      }
    }
    return {below.mean(step, kMeans),
            below.with(above).mean(step, kWideMeans),
            wideBelow.mean(step, kWideMeans),
            wideBelow.with(wideAbove).mean(step, kWideMeans),
            static_cast<std::size_t>(std::min(below.count, kTrusts - 1)),
            static_cast<std::size_t>(std::min(wideBelow.count / 2, kWideTrusts - 1)),
            static_cast<std::size_t>(std::min((members - 1) / 2, kShares - 1))};
  }

  /// A neighbour of a block, one block away on one or two axes, at a higher offset in a window. At
  /// the opposite offset there is one of the same weight.
  struct Neighbour {
    int16_t offset, weight;
  };
  static constexpr auto kAbove = [] {
    std::array<Neighbour, D * D> neighbours{};
    std::size_t count = 0;
    for (int a = 0; a < D; ++a) {
      const int along = DisplacementWindow<D>::stride(a);
      neighbours[count++] = {static_cast<int16_t>(along), 2};
      for (int b = 0; b < a; ++b) {
        for (const int side : {-1, 1})
          neighbours[count++] = {
              static_cast<int16_t>(along + side * DisplacementWindow<D>::stride(b)), 1};
      }
    }
    return neighbours;
  }();

  template <DisplacementExchange Exchange>
  int code(Exchange& exchange, const Context& c, int actual) {
    const auto decide = [&](int n, bool answer) {
      const auto decision = static_cast<std::size_t>(n);
      return Mixer<kInputs>::template bit<255, 11>(
          exchange.coder(), answer,
          {&byBelow_[((decision * kMeans + c.below) * kTrusts + c.trust) * kShares + c.share],
           &byAround_[(decision * kWideMeans + c.around) * kTrusts + c.trust],
           &byBoth_[(decision * kMeans + c.below) * kWideMeans + c.around],
           &byWide_[((decision * kWideMeans + c.wideBelow) * kWideTrusts + c.wideTrust) *
                        kWideMeans +
                    c.wideAround]},
          weights_[decision]);
    };
    return codeSignedUnary(actual, kMost, decide);
  }

  Tube<D> tube_;
  DisplacementWindow<D> window_;
  std::array<bool, Values::kBlocks> members_{};
  std::array<BitModel, kDecisions * kMeans * kTrusts * kShares> byBelow_;
  std::array<BitModel, kDecisions * kWideMeans * kTrusts> byAround_;
  std::array<BitModel, kDecisions * kMeans * kWideMeans> byBoth_;
  std::array<BitModel, kDecisions * kWideMeans * kWideTrusts * kWideMeans> byWide_;
  std::array<typename Mixer<kInputs>::Weights, kDecisions> weights_;
};

}  // namespace isostar
