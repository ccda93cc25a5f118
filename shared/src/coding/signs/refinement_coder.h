// Refinement (§5.2): D bisections lead from one octave to the next; at each the signs of the new vertices are told.
#pragma once

#include "coding/signs/new_component_coder.h"
#include "grid/refined_signs.h"
#include "coding/signs/sign_coder.h"
#include "coding/signs/keep_coder.h"

namespace isostar {

/// Tells an octave's fresh vertices, by the number of axes on which they are fresh: D (centres of cells), … 1 (midpoints
/// of their edges). A vertex whose diamond has both signs is told by a decision in context. One whose diamond is
/// uniform has its sign deduced, unless a component of the surface first appears there: these exceptions are localized
/// by brick, row and vertex, so that the octave's signs are the source's, every component and no more.
template <int D>
class RefinementCoder {
 public:
  /// All bisections of an octave, slab of bricks by slab: each bisection follows the one before a slab behind, where all
  /// that it looks at has been told, so that of a stream that ends early all before a few places is known. Of an adaptive octave
  /// `absent` are the vertices that are not in the mesh: the first bisection tells of each crossing cell whether it stays
  /// whole, and a vertex whose diamond has an absent one is absent too, so that the mesh conforms.
  template <class Exchange>
  void tell(Exchange& ask, Signs<D>& signs, Signs<D>* absent = nullptr) {
    absent_ = absent;
    active_ = activeBricks(signs);
    if (absent != nullptr) {
      const auto near = activeBricks(*absent);
      for (std::size_t place = 0; place < near.size(); ++place) active_[place] |= near[place];
    }
    told_.fill(0);
    const auto slabs = static_cast<std::size_t>(signs.table().count(D - 1));
    for (std::size_t step = 0; step < slabs + D - 1; ++step) {
      for (int dimension = D; dimension >= 1; --dimension) {
        const std::size_t slab = step + static_cast<std::size_t>(dimension) - D;  // wraps around before the first
        if (slab >= slabs) continue;
        bisect(ask, signs, dimension, slab);
        if (ask.spent(signs.memory() + memory())) return;
      }
    }
  }

  /// Of an octave that has been told in part: the fresh vertices near the surface that have not.
  [[nodiscard]] ISOSTAR_SELDOM Signs<D> untold(const Signs<D>& signs) const {
    Signs<D> result(signs.lattice());
    for (std::size_t place = 0; place < active_.size(); ++place) {
      if (active_[place] == 0) continue;
      forEachFresh(signs.lattice(), signs.table().brick(place), [&](const Coordinates<D>& v, std::size_t dimension) {
        if (place >= told_[dimension]) result.set(v, true);
      });
    }
    return result;
  }
  /// The bricks of the octave told last that touch the surface, and a few others, 1 marked, by place; none the second time.
  [[nodiscard]] std::vector<uint8_t> takeActive() { return std::move(active_); }
  /// Has any of the octave been told?
  [[nodiscard]] bool began() const { return told_[D] != 0; }

  /// Bytes in use beside the models, while one more place changes.
  [[nodiscard]] uint64_t memory() const { return active_.capacity() + memoryToGrow(changedPlaces_) + memoryToGrow(absentPlaces_); }

 private:
  static constexpr std::size_t kGroup = 64;  // quiet bricks in a row that share a flag

  /// One bisection of a slab: tells the vertices fresh on `dimension` axes.
  template <class Exchange>
  void bisect(Exchange& ask, Signs<D>& signs, int dimension, std::size_t slab) {
    const std::size_t size = signs.table().stride(D - 1), begin = slab * size, end = begin + size;
    for (std::size_t first = begin; first < end && !ask.spent(signs.memory() + memory()); first += kGroup) {
      quietGroup(ask, signs, dimension, first, std::min(first + kGroup, end));
    }
    std::size_t& told = told_[static_cast<std::size_t>(dimension)];
    for (std::size_t place = begin; place < end && !ask.spent(signs.memory() + memory()); ++place) {
      told = place;
      if (active_[place] != 0) brick(ask, signs, place, dimension);
    }
    if (!ask.spent(signs.memory() + memory())) told = end;  // else what was read of the last brick may be noise
    for (const std::size_t place : changedPlaces_) activateAround(signs, place, active_);
    changedPlaces_.clear();
    for (const std::size_t place : absentPlaces_) activateAround(*absent_, place, active_);
    absentPlaces_.clear();
  }

  /// Components that first appear far from the surface.
  template <class Exchange>
  void quietGroup(Exchange& ask, Signs<D>& signs, int dimension, std::size_t first, std::size_t end) {
    bool any = false, quiet = false;
    for (std::size_t place = first; place < end; ++place) {
      if (active_[place] != 0) continue;
      quiet = true;
      any = any || differs(ask, signs, place, dimension);
    }
    if (!quiet || !exceptions_.inGroup(ask.coder(), dimension, any)) return;
    for (std::size_t place = first; place < end && !ask.spent(signs.memory() + memory()); ++place) {
      if (active_[place] != 0 || !exceptions_.inQuietBrick(ask.coder(), dimension, differs(ask, signs, place, dimension))) continue;
      rows_.enter(signs, absent_, place, dimension);
      exceptions_.tellRows(ask, place, rows_, 0);
      store(signs, place);
    }
  }

  /// Has a uniform brick vertices of the class that are not of its sign?
  template <class Exchange>
  bool differs(Exchange& ask, const Signs<D>& signs, std::size_t place, int dimension) {
    if (!ask.varies(place, signs.index(place))) return false;
    rows_.find(signs.lattice(), signs.table().brick(place), dimension);
    const uint32_t uniform = signs.index(place) == Signs<D>::kPositive ? 0xFF : 0;
    uint32_t difference = 0;
    for (int i = 0; i < rows_.count(); ++i) difference |= (ask.row(place, rows_.row(i).brick) ^ uniform) & rows_.row(i).members;
    return difference != 0;
  }

  template <class Exchange>
  void brick(Exchange& ask, Signs<D>& signs, std::size_t place, int dimension) {
    rows_.enter(signs, absent_, place, dimension);
    if (absent_ != nullptr) {
      if (dimension == D) wholeCells_.tell(ask, place, rows_);
      storeAbsent(place);
    }
    const int told = signs_.tell(ask, place, rows_);
    exceptions_.tell(ask, place, rows_, dimension, told);
    if (rows_.changed()) store(signs, place);
  }

  void store(Signs<D>& signs, std::size_t place) {
    changedPlaces_.push_back(place);
    rows_.store(signs, place);
  }

  void storeAbsent(std::size_t place) {
    uint32_t any = 0;
    for (int i = 0; i < rows_.count(); ++i) any |= rows_.row(i).absent;
    if (any == 0) return;
    absentPlaces_.push_back(place);
    auto& bytes = absent_->writable(place).rows;
    for (int i = 0; i < rows_.count(); ++i) bytes[rows_.row(i).brick] = static_cast<uint8_t>(bytes[rows_.row(i).brick] | rows_.row(i).absent);
  }

  /// Calls visit(v, on how many axes it is fresh) for the fresh vertices of a brick.
  template <class Visit>
  ISOSTAR_SELDOM static void forEachFresh(const Lattice<D>& lattice, const Coordinates<D>& brick, Visit visit) {
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      low[a] = brick[a] * kBrickSide;
      high[a] = std::min(low[a] + kBrickSide - 1, lattice.last[a]);
    }
    forEachBetween<D>(low, high, [&](const Coordinates<D>& v) {
      const auto dimension = static_cast<std::size_t>(std::popcount(lattice.freshAxes(v)));
      if (dimension != 0) visit(v, dimension);
    });
  }

  Signs<D>* absent_ = nullptr;   // null: all are in the mesh
  std::vector<uint8_t> active_;  // bricks of the octave in work, as of activeBricks()
  std::vector<std::size_t> changedPlaces_, absentPlaces_;  // in this bisection of this slab
  std::array<std::size_t, D + 1> told_{};                  // by bisection: the bricks before this place
  FreshRows<D> rows_;
  SignCoder<D> signs_;
  WholeCellCoder<D> wholeCells_;
  ExceptionCoder<D> exceptions_;
};

}  // namespace isostar
