// Refinement (§5.2): D bisections lead from one level to the next, and each codes the signs of its
// new vertices.
#pragma once

#include "coding/signs/keep_coder.h"
#include "coding/signs/new_component_coder.h"
#include "coding/signs/sign_coder.h"
#include "grid/refined_signs.h"
#include "util/cold_path.h"
#include "util/decodes_all.h"

namespace isostar {

/// Codes a level's new vertices by the number of their new axes: D (centres of cells), … 1
/// (midpoints of cells' edges). A vertex whose diamond has both signs is coded in context. A vertex
/// whose diamond is uniform has its sign deduced, unless a new component appears there: such
/// mispredictions are localized by brick, row and vertex. So the level's signs are exactly the
/// source's, with every component and no others.
template <int D>
class RefinementCoder {
 public:
  /// Codes all bisections of a level, one slab of bricks after the other. Each bisection runs one
  /// slab behind the previous one, so that all signs it depends on are coded. If the stream ends
  /// early, everything before a few bricks is then known. For an adaptive mesh `absent` is the set
  /// of absent vertices: the first bisection codes which crossing cells are kept, and a vertex with
  /// an absent one in its diamond is absent too, so that the mesh conforms. `foreign`: marks, by
  /// brick index, bricks that are not coded; they keep the signs that they have. Not inlined, to
  /// keep the WebAssembly decoder small.
  template <SignExchange Exchange>
  [[gnu::noinline]] void code(Exchange& exchange, Signs<D>& signs, Signs<D>* absent = nullptr,
                              const std::vector<uint8_t>* foreign = nullptr) {
    absent_ = absent;
    active_ = activeBricks(signs);
    if (hasAbsent()) {
      const auto besideAbsent = activeBricks(*absent);
      for (std::size_t brickIndex = 0; brickIndex < besideAbsent.size(); ++brickIndex)
        active_[brickIndex] |= besideAbsent[brickIndex];
    }
    for (std::size_t i = 0; foreign != nullptr && i < active_.size(); ++i)
      active_[i] = (*foreign)[i] != 0 ? kForeign : active_[i];
    coded_.fill(0);
    const auto slabs = static_cast<std::size_t>(signs.table().count(D - 1));
    for (std::size_t step = 0; step < slabs + D - 1; ++step) {
      for (int newAxisCount = D; newAxisCount >= 1; --newAxisCount) {
        // Wraps around before the first slab.
        const std::size_t slab = step + static_cast<std::size_t>(newAxisCount) - D;
        if (slab >= slabs) continue;
        bisect(exchange, signs, newAxisCount, slab);
        if (!exchange.charge(signs.memory() + memory())) return;
      }
    }
  }

  /// For a level that is only partly coded: the new vertices near the surface whose signs
  /// are not coded.
  [[nodiscard]] ISOSTAR_COLD Signs<D> uncoded(const Signs<D>& signs) const {
    Signs<D> result(signs.lattice());
    for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
      if (active_[brickIndex] != kActive) continue;
      forEachNew(signs.lattice(), signs.table().brick(brickIndex),
                 [&](const Coordinates<D>& v, std::size_t newAxisCount) {
                   if (brickIndex >= coded_[newAxisCount]) result.set(v, true);
                 });
    }
    return result;
  }
  /// The new vertices of marked bricks.
  [[nodiscard]] ISOSTAR_COLD static Signs<D> newVertices(const Signs<D>& signs,
                                                         const std::vector<uint8_t>& marks) {
    Signs<D> result(signs.lattice());
    for (std::size_t brickIndex = 0; brickIndex < marks.size(); ++brickIndex) {
      if (marks[brickIndex] != 0)
        forEachNew(signs.lattice(), signs.table().brick(brickIndex),
                   [&](const Coordinates<D>& v, std::size_t) { result.set(v, true); });
    }
    return result;
  }
  /// Marks, by brick index, the bricks of the last coded level that touch the surface, and a few
  /// others. Moves them out: a second call returns nothing.
  [[nodiscard]] std::vector<uint8_t> takeActive() { return std::move(active_); }
  /// Has any part of the level been coded?
  [[nodiscard]] bool began() const { return coded_[D] != 0; }

  /// Bytes in use beside the models while one more brick changes.
  [[nodiscard]] uint64_t memory() const {
    return active_.capacity() + memoryToGrow(changedBricks_) + memoryToGrow(bricksWithAbsent_);
  }

 private:
  static constexpr uint8_t kActive = 1, kForeign = 2;  // in active_; all others are quiet
  static constexpr std::size_t kGroup = 64;  // consecutive bricks whose quiet ones share a flag

  /// One bisection of a slab: codes the vertices with `newAxisCount` new axes.
  template <SignExchange Exchange>
  void bisect(Exchange& exchange, Signs<D>& signs, int newAxisCount, std::size_t slab) {
    const std::size_t size = signs.table().stride(D - 1), begin = slab * size, end = begin + size;
    quietBricks(exchange, signs, newAxisCount, begin, end);
    std::size_t& coded = coded_[static_cast<std::size_t>(newAxisCount)];
    for (std::size_t brickIndex = begin;
         brickIndex < end && exchange.charge(signs.memory() + memory()); ++brickIndex) {
      coded = brickIndex;
      if (active_[brickIndex] == kActive) brick(exchange, signs, brickIndex, newAxisCount);
    }
    // Otherwise the last brick's signs may be noise.
    if (exchange.charge(signs.memory() + memory())) coded = end;
    for (const std::size_t brickIndex : changedBricks_) activateAround(signs, brickIndex, active_);
    changedBricks_.clear();
    if (!hasAbsent()) return;
    for (const std::size_t brickIndex : bricksWithAbsent_)
      activateAround(*absent_, brickIndex, active_);
    bricksWithAbsent_.clear();
  }

  /// Codes new components in those bricks of a slab that the coarser surface does not touch.
  template <SignExchange Exchange>
  void quietBricks(Exchange& exchange, Signs<D>& signs, int newAxisCount, std::size_t begin,
                   std::size_t end) {
    for (std::size_t first = begin; first < end && exchange.charge(signs.memory() + memory());
         first += kGroup) {
      const std::size_t last = std::min(first + kGroup, end);
      if (!newComponents_.codeGroup(exchange, signs, active_, rows_, first, last, newAxisCount))
        continue;
      for (std::size_t brickIndex = first;
           brickIndex < last && exchange.charge(signs.memory() + memory()); ++brickIndex) {
        if (active_[brickIndex] != 0 ||
            !newComponents_.codeQuietBrick(exchange, signs, rows_, brickIndex, newAxisCount))
          continue;
        exchange.visitBrick();
        rows_.enter(signs, hasAbsent() ? absent_ : nullptr, brickIndex, newAxisCount);
        newComponents_.codeRows(exchange, brickIndex, rows_, 0);
        store(signs, brickIndex);
      }
    }
  }

  template <SignExchange Exchange>
  void brick(Exchange& exchange, Signs<D>& signs, std::size_t brickIndex, int newAxisCount) {
    exchange.visitBrick();
    rows_.enter(signs, hasAbsent() ? absent_ : nullptr, brickIndex, newAxisCount);
    if (hasAbsent()) {
      if (newAxisCount == D) keeps_.code(exchange, brickIndex, rows_);
      storeAbsent(brickIndex);
    }
    const int coded = signs_.code(exchange, brickIndex, rows_);
    newComponents_.code(exchange, brickIndex, rows_, newAxisCount, coded);
    if (rows_.changed()) store(signs, brickIndex);
  }

  /// Is the mesh adaptive?
  [[nodiscard]] bool hasAbsent() const { return kDecodesAll && absent_ != nullptr; }

  void store(Signs<D>& signs, std::size_t brickIndex) {
    changedBricks_.push_back(brickIndex);
    rows_.store(signs, brickIndex);
  }

  void storeAbsent(std::size_t brickIndex) {
    uint32_t any = 0;
    for (int i = 0; i < rows_.count(); ++i) any |= rows_.row(i).absent;
    if (any == 0) return;
    bricksWithAbsent_.push_back(brickIndex);
    auto& bytes = absent_->writable(brickIndex).rows;
    for (int i = 0; i < rows_.count(); ++i)
      bytes[rows_.row(i).brick] =
          static_cast<uint8_t>(bytes[rows_.row(i).brick] | rows_.row(i).absent);
  }

  /// Calls visit(v, number of its new axes) for the new vertices of a brick.
  template <class Visit>
  ISOSTAR_COLD static void forEachNew(const Lattice<D>& lattice, const Coordinates<D>& brick,
                                      Visit visit) {
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      low[a] = brick[a] * kBrickSide;
      high[a] = std::min(low[a] + kBrickSide - 1, lattice.last[a]);
    }
    forEachBetween<D>(low, high, [&](const Coordinates<D>& v) {
      const auto newAxisCount = static_cast<std::size_t>(std::popcount(lattice.newAxes(v)));
      if (newAxisCount != 0) visit(v, newAxisCount);
    });
  }

  Signs<D>* absent_ = nullptr;   // null: no vertex is absent
  std::vector<uint8_t> active_;  // of the current level, as of activeBricks(), or kForeign
  std::vector<std::size_t> changedBricks_, bricksWithAbsent_;  // in this bisection of this slab
  /// By number of new axes: the index before which all bricks are coded.
  std::array<std::size_t, D + 1> coded_{};
  NewVertexRows<D> rows_;
  SignCoder<D> signs_;
  KeepCoder<D> keeps_;
  NewComponentCoder<D> newComponents_;
};

}  // namespace isostar
