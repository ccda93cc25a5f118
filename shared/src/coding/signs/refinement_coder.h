// Refinement (§5.2): D bisections lead from one octave to the next; at each the signs of the new
// vertices are told.
#pragma once

#include "coding/signs/keep_coder.h"
#include "coding/signs/new_component_coder.h"
#include "coding/signs/sign_coder.h"
#include "grid/refined_signs.h"

namespace isostar {

/// Tells an octave's fresh vertices, by the number of axes on which they are fresh: D (centres of
/// cells), … 1 (midpoints of their edges). A vertex whose diamond has both signs is told by a
/// decision in context. One whose diamond is uniform has its sign deduced, unless a component of
/// the surface first appears there: these exceptions are localized by brick, row and vertex, so
/// that the octave's signs are the source's, every component and no more.
template <int D>
class RefinementCoder {
 public:
  /// All bisections of an octave, slab of bricks by slab: each bisection follows the one before a
  /// slab behind, where all that it looks at has been told, so that of a stream that ends early all
  /// before a few places is known. Of an adaptive octave `absent` are the vertices that are not in
  /// the mesh: the first bisection tells of each crossing cell whether it stays whole, and a vertex
  /// whose diamond has an absent one is absent too, so that the mesh conforms.
  template <SignExchange Exchange>
  void code(Exchange& exchange, Signs<D>& signs, Signs<D>* absent = nullptr) {
    absent_ = absent;
    active_ = activeBricks(signs);
    if (absent != nullptr) {
      const auto near = activeBricks(*absent);
      for (std::size_t brickIndex = 0; brickIndex < near.size(); ++brickIndex)
        active_[brickIndex] |= near[brickIndex];
    }
    coded_.fill(0);
    const auto slabs = static_cast<std::size_t>(signs.table().count(D - 1));
    for (std::size_t step = 0; step < slabs + D - 1; ++step) {
      for (int dimension = D; dimension >= 1; --dimension) {
        const std::size_t slab =
            step + static_cast<std::size_t>(dimension) - D;  // wraps around before the first
        if (slab >= slabs) continue;
        bisect(exchange, signs, dimension, slab);
        if (!exchange.charge(signs.memory() + memory())) return;
      }
    }
  }

  /// Of an octave that has been told in part: the fresh vertices near the surface that have not.
  [[nodiscard]] ISOSTAR_COLD Signs<D> uncoded(const Signs<D>& signs) const {
    Signs<D> result(signs.lattice());
    for (std::size_t brickIndex = 0; brickIndex < active_.size(); ++brickIndex) {
      if (active_[brickIndex] == 0) continue;
      forEachNew(signs.lattice(), signs.table().brick(brickIndex),
                 [&](const Coordinates<D>& v, std::size_t dimension) {
                   if (brickIndex >= coded_[dimension]) result.set(v, true);
                 });
    }
    return result;
  }
  /// The bricks of the octave told last that touch the surface, and a few others, 1 marked, by
  /// place; none the second time.
  [[nodiscard]] std::vector<uint8_t> takeActive() { return std::move(active_); }
  /// Has any of the octave been told?
  [[nodiscard]] bool began() const { return coded_[D] != 0; }

  /// Bytes in use beside the models, while one more place changes.
  [[nodiscard]] uint64_t memory() const {
    return active_.capacity() + memoryToGrow(changedBricks_) + memoryToGrow(bricksWithAbsent_);
  }

 private:
  static constexpr std::size_t kGroup = 64;  // quiet bricks in a row that share a flag

  /// One bisection of a slab: tells the vertices fresh on `dimension` axes.
  template <SignExchange Exchange>
  void bisect(Exchange& exchange, Signs<D>& signs, int dimension, std::size_t slab) {
    const std::size_t size = signs.table().stride(D - 1), begin = slab * size, end = begin + size;
    quietBricks(exchange, signs, dimension, begin, end);
    std::size_t& coded = coded_[static_cast<std::size_t>(dimension)];
    for (std::size_t brickIndex = begin;
         brickIndex < end && exchange.charge(signs.memory() + memory()); ++brickIndex) {
      coded = brickIndex;
      if (active_[brickIndex] != 0) brick(exchange, signs, brickIndex, dimension);
    }
    if (exchange.charge(signs.memory() + memory()))
      coded = end;  // else what was read of the last brick may be noise
    for (const std::size_t brickIndex : changedBricks_) activateAround(signs, brickIndex, active_);
    changedBricks_.clear();
    for (const std::size_t brickIndex : bricksWithAbsent_)
      activateAround(*absent_, brickIndex, active_);
    bricksWithAbsent_.clear();
  }

  /// New components in a slab's bricks that the coarser surface does not touch.
  template <SignExchange Exchange>
  void quietBricks(Exchange& exchange, Signs<D>& signs, int dimension, std::size_t begin,
                   std::size_t end) {
    for (std::size_t first = begin; first < end && exchange.charge(signs.memory() + memory());
         first += kGroup) {
      const std::size_t last = std::min(first + kGroup, end);
      if (!newComponents_.codeGroup(exchange, signs, active_, rows_, first, last, dimension))
        continue;
      for (std::size_t brickIndex = first;
           brickIndex < last && exchange.charge(signs.memory() + memory()); ++brickIndex) {
        if (active_[brickIndex] != 0 ||
            !newComponents_.codeQuietBrick(exchange, signs, rows_, brickIndex, dimension))
          continue;
        rows_.enter(signs, absent_, brickIndex, dimension);
        newComponents_.codeRows(exchange, brickIndex, rows_, 0);
        store(signs, brickIndex);
      }
    }
  }

  template <SignExchange Exchange>
  void brick(Exchange& exchange, Signs<D>& signs, std::size_t brickIndex, int dimension) {
    rows_.enter(signs, absent_, brickIndex, dimension);
    if (absent_ != nullptr) {
      if (dimension == D) keeps_.code(exchange, brickIndex, rows_);
      storeAbsent(brickIndex);
    }
    const int coded = signs_.code(exchange, brickIndex, rows_);
    newComponents_.code(exchange, brickIndex, rows_, dimension, coded);
    if (rows_.changed()) store(signs, brickIndex);
  }

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

  /// Calls visit(v, on how many axes it is fresh) for the fresh vertices of a brick.
  template <class Visit>
  ISOSTAR_COLD static void forEachNew(const Lattice<D>& lattice, const Coordinates<D>& brick,
                                      Visit visit) {
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      low[a] = brick[a] * kBrickSide;
      high[a] = std::min(low[a] + kBrickSide - 1, lattice.last[a]);
    }
    forEachBetween<D>(low, high, [&](const Coordinates<D>& v) {
      const auto dimension = static_cast<std::size_t>(std::popcount(lattice.newAxes(v)));
      if (dimension != 0) visit(v, dimension);
    });
  }

  Signs<D>* absent_ = nullptr;   // null: all are in the mesh
  std::vector<uint8_t> active_;  // bricks of the octave in work, as of activeBricks()
  std::vector<std::size_t> changedBricks_, bricksWithAbsent_;  // in this bisection of this slab
  std::array<std::size_t, D + 1> coded_{};  // by bisection: the bricks before this place
  NewVertexRows<D> rows_;
  SignCoder<D> signs_;
  KeepCoder<D> keeps_;
  NewComponentCoder<D> newComponents_;
};

}  // namespace isostar
