#pragma once

#include <bit>
#include <cmath>
#include <vector>

#include "entropy/models.h"
#include "grid/signs.h"

namespace isostar::bench {

/// Codes the signs of an octree's corners level by level, after H. Lee, M. Desbrun, P. Schröder,
/// Progressive encoding of complex isosurfaces (2003). New corners are coded only in parents with
/// samples of both signs. For a child whose corners have one sign, a bit says whether it has
/// samples of both signs nevertheless. All other cells have one sign.
class OctreeSigns {
 public:
  OctreeSigns(const Coordinates<3>& lastSample, int levels)
      : last_(lastSample), levels_(levels), signs_(Lattice<3>(lastSample, 1).vertices(), kUnknown) {
    for (auto& w : signWeights_) w = Mixer<4>::initialWeights();
    for (auto& w : mixedWeights_) w = Mixer<2>::initialWeights();
  }

  [[nodiscard]] Lattice<3> lattice(int level) const {
    return Lattice<3>(last_, int32_t{1} << (levels_ - level));
  }

  /// Codes the signs of a level after those of the level before. `actual` is an OctreeEncoderSide
  /// or an OctreeDecoderSide.
  template <class Coder, class Actual>
  void code(Coder& coder, const Actual& actual, int level) {
    const auto grid = lattice(level);
    std::vector<Coordinates<3>> cells;
    if (level == 0) {
      forEach({0, 0, 0}, grid.last, [&](const auto& v) { codeSign(coder, actual, grid, v, 0); });
      forEach({0, 0, 0}, minusOne(grid.last), [&](const auto& cell) { cells.push_back(cell); });
    } else {
      // First the corners on edges, then on faces, then in the interior: each lies between corners
      // that are already coded.
      for (int newAxisCount = 1; newAxisCount <= 3; ++newAxisCount) {
        for (const auto& parent : active_) {
          forEach(lowest(parent), highest(grid, parent), [&](const auto& v) {
            if (newAxesOf(grid, v) == newAxisCount) codeSign(coder, actual, grid, v, newAxisCount);
          });
        }
      }
      for (const auto& parent : active_) {
        forEach(lowest(parent), minusOne(highest(grid, parent)),
                [&](const auto& cell) { cells.push_back(cell); });
      }
    }
    active_.clear();
    for (const auto& cell : cells) {
      if (isMixed(coder, actual, grid, level, cell))
        active_.push_back(cell);
      else
        settle(grid, cell);
    }
  }

  /// The sign of a vertex of a coded level.
  [[nodiscard]] bool positive(const Lattice<3>& grid, const Coordinates<3>& v) const {
    return at(grid, v) == kPositive;
  }

 private:
  enum Sign : uint8_t { kNegative, kPositive, kUnknown };

  static Coordinates<3> minusOne(Coordinates<3> v) {
    for (int32_t& x : v) --x;
    return v;
  }
  static Coordinates<3> lowest(Coordinates<3> parent) {
    for (int32_t& x : parent) x *= 2;
    return parent;
  }
  static Coordinates<3> highest(const Lattice<3>& grid, Coordinates<3> parent) {
    for (int a = 0; a < 3; ++a) parent[a] = std::min(2 * parent[a] + 2, grid.last[a]);
    return parent;
  }
  static int newAxesOf(const Lattice<3>& grid, const Coordinates<3>& v) {
    return grid.isNew(0, v[0]) + grid.isNew(1, v[1]) + grid.isNew(2, v[2]);
  }
  template <class Visit>
  static void forEach(const Coordinates<3>& first, const Coordinates<3>& last, Visit visit) {
    for (int32_t z = first[2]; z <= last[2]; ++z) {
      for (int32_t y = first[1]; y <= last[1]; ++y) {
        for (int32_t x = first[0]; x <= last[0]; ++x) visit(Coordinates<3>{x, y, z});
      }
    }
  }

  [[nodiscard]] size_t index(const Coordinates<3>& sample) const {
    return (static_cast<size_t>(sample[2]) * static_cast<size_t>(last_[1] + 1) +
            static_cast<size_t>(sample[1])) *
               static_cast<size_t>(last_[0] + 1) +
           static_cast<size_t>(sample[0]);
  }
  [[nodiscard]] static Coordinates<3> sampleOf(const Lattice<3>& grid, Coordinates<3> v) {
    for (int a = 0; a < 3; ++a) v[a] = grid.sample(a, v[a]);
    return v;
  }
  [[nodiscard]] uint8_t at(const Lattice<3>& grid, const Coordinates<3>& v) const {
    return signs_[index(sampleOf(grid, v))];
  }
  /// The sign of a neighbour, as 1, -1 or 0 (unknown); mirrored at the sides of the box.
  [[nodiscard]] int beside(const Lattice<3>& grid, const Coordinates<3>& v, int x, int y,
                           int z) const {
    const uint8_t sign = at(
        grid, {grid.mirrored(0, v[0] + x), grid.mirrored(1, v[1] + y), grid.mirrored(2, v[2] + z)});
    return sign == kUnknown ? 0 : sign == kPositive ? 1 : -1;
  }

  /// A weighted sum of the 125 signs around a vertex, clamped to 0 … kVotes - 1.
  [[nodiscard]] size_t vote(const Lattice<3>& grid, const Coordinates<3>& v) const {
    /// By squared distance.
    static constexpr int kVoteWeights[13] = {0, 60, 42, 26, 20, 16, 10, 0, 7, 6, 0, 0, 4};
    int sum = 0;
    for (int z = -2; z <= 2; ++z) {
      for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x)
          sum += kVoteWeights[x * x + y * y + z * z] * beside(grid, v, x, y, z);
      }
    }
    return static_cast<size_t>(std::clamp(sum / 24 + kVotes / 2, 0, kVotes - 1));
  }

  /// The signs of the corners of the parent's edge, face or cube whose centre is the vertex, and of
  /// the vertices between them and the centre.
  [[nodiscard]] size_t patternBetween(const Lattice<3>& grid, const Coordinates<3>& v,
                                      int newAxisCount) const {
    size_t pattern = 0;
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const int steps = std::abs(x) + std::abs(y) + std::abs(z);
          const bool within = (x == 0 || grid.isNew(0, v[0])) && (y == 0 || grid.isNew(1, v[1])) &&
                              (z == 0 || grid.isNew(2, v[2]));
          if (within && (steps == 1 || steps == newAxisCount))
            pattern = pattern << 1 | (beside(grid, v, x, y, z) > 0 ? 1u : 0u);
        }
      }
    }
    return pattern;
  }

  /// The sum of the six signs along the axes at a distance, as 0 … 12.
  [[nodiscard]] size_t sumOfSix(const Lattice<3>& grid, const Coordinates<3>& v,
                                int distance) const {
    int sum = 6;
    for (int by : {-distance, distance})
      sum += beside(grid, v, by, 0, 0) + beside(grid, v, 0, by, 0) + beside(grid, v, 0, 0, by);
    return static_cast<size_t>(sum);
  }

  template <class Coder, class Actual>
  void codeSign(Coder& coder, const Actual& actual, const Lattice<3>& grid, const Coordinates<3>& v,
                int newAxisCount) {
    const auto sample = sampleOf(grid, v);
    uint8_t& sign = signs_[index(sample)];
    if (sign != kUnknown) return;
    const size_t between = newAxisCount == 0 ? 0 : patternBetween(grid, v, newAxisCount),
                 adjacent = sumOfSix(grid, v, 1), second = sumOfSix(grid, v, 2);
    const auto kind = static_cast<size_t>(newAxisCount), votes = vote(grid, v);
    const std::array<BitModel*, 4> contexts{
        &signByBetween_[kind][between], &signByVote_[kind][votes],
        &signBySides_[kind][adjacent][second], &signByBoth_[kind][votes / 4][between & 15]};
    const bool coded =
        Mixer<4>::bit<127, 10>(coder, actual.positive(sample), contexts, signWeights_[kind]);
    sign = coded ? kPositive : kNegative;
  }

  /// Whether the cell has samples of both signs: known from its corners, or coded in a bit.
  template <class Coder, class Actual>
  bool isMixed(Coder& coder, const Actual& actual, const Lattice<3>& grid, int level,
               const Coordinates<3>& cell) {
    int positives = 0;
    for (int corner = 0; corner < 8; ++corner)
      positives += positive(
          grid, {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)});
    if (positives != 0 && positives != 8) return true;
    if (level == levels_) return false;
    const std::array<BitModel*, 2> contexts{
        &mixedByLevel_[static_cast<size_t>(std::min(level, 31))][positives != 0],
        &mixedByVote_[vote(grid, cell)][positives != 0]};
    return Mixer<2>::bit<127, 10>(coder, actual.mixed(level, cell), contexts,
                                  mixedWeights_[positives != 0]);
  }

  /// Sets all samples of a cell to the sign of its corners.
  void settle(const Lattice<3>& grid, const Coordinates<3>& cell) {
    const auto first = sampleOf(grid, cell),
               last = sampleOf(grid, {cell[0] + 1, cell[1] + 1, cell[2] + 1});
    const uint8_t sign = signs_[index(first)];
    for (int32_t z = first[2]; z <= last[2]; ++z) {
      for (int32_t y = first[1]; y <= last[1]; ++y) {
        for (int32_t x = first[0]; x <= last[0]; ++x) signs_[index({x, y, z})] = sign;
      }
    }
  }

  static constexpr int kVotes = 64;

  Coordinates<3> last_;
  int levels_;
  std::vector<uint8_t> signs_;          // by sample
  std::vector<Coordinates<3>> active_;  // cells of the last coded level with samples of both signs
  std::array<std::array<BitModel, 1 << 14>, 4> signByBetween_;
  std::array<std::array<BitModel, kVotes>, 4> signByVote_;
  std::array<std::array<std::array<BitModel, 13>, 13>, 4> signBySides_;
  std::array<std::array<std::array<BitModel, 16>, kVotes / 4>, 4> signByBoth_;
  std::array<Mixer<4>::Weights, 4> signWeights_;
  std::array<std::array<BitModel, 2>, 32> mixedByLevel_;
  std::array<std::array<BitModel, 2>, kVotes> mixedByVote_;
  std::array<Mixer<2>::Weights, 2> mixedWeights_;
};

}  // namespace isostar::bench
