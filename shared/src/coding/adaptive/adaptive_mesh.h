// An adaptive mesh of the RBMT (§4.3, §5.1, §5.2): octave by octave, for both directions.
#pragma once

#include "coding/signs/base_coder.h"
#include "coding/signs/filling_coder.h"
#include "coding/signs/refinement_coder.h"
#include "grid/refined_signs.h"
#include "util/cold_path.h"

namespace isostar {

/// An adaptive mesh is one of whole octaves with absent vertices: a crossing cell that is kept
/// whole has none of the vertices that would split it, nor have its neighbours those that need
/// them.
template <int D>
class AdaptiveMesh {
 public:
  explicit AdaptiveMesh(const Lattice<D>& base)
      : signs_(1, Signs<D>(base)), absent_(1, Signs<D>(base)), coders_(std::in_place) {}

  /// Of an octave without absent vertices and the next one, to show what is known of it: no more of
  /// it can be told.
  AdaptiveMesh(Signs<D> coarse, Signs<D> fine, Signs<D> absent)
      : absent_(1, Signs<D>(coarse.lattice())) {
    signs_.push_back(std::move(coarse));
    signs_.push_back(std::move(fine));
    absent_.push_back(std::move(absent));
  }

  [[nodiscard]] int level() const { return static_cast<int>(signs_.size()) - 1; }
  [[nodiscard]] const Signs<D>& signs(int level) const {
    return signs_[static_cast<std::size_t>(level)];
  }
  [[nodiscard]] const Signs<D>& absent(int level) const {
    return absent_[static_cast<std::size_t>(level)];
  }
  /// Has the mesh a vertex of an octave, and is it one of a simplex that is not split further?
  [[nodiscard]] bool belongsToLeaf(int level, const Coordinates<D>& v) const {
    if (absent(level).at(v)) return false;
    if (level == this->level()) return true;
    const auto& finer = absent(level + 1);
    const auto middle = absent(level).lattice().onFiner(v);
    Coordinates<D> low, high;
    for (int a = 0; a < D; ++a) {
      low[a] = std::max(middle[a] - 1, 0);
      high[a] = std::min(middle[a] + 1, finer.lattice().last[a]);
    }
    bool any = false;
    forEachBetween<D>(low, high, [&](const Coordinates<D>& w) { any = any || finer.at(w); });
    return any;
  }

  /// Bytes in use beside the models, while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = coders_ ? coders_->refinement.memory() : 0;
    for (const auto& s : signs_) sum += s.memory();
    for (const auto& s : absent_) sum += s.memory();
    return sum;
  }
  /// What it takes at most, on top of that, to begin the next octave.
  [[nodiscard]] uint64_t memoryToRefine() const {
    const BrickTable<D> finer(signs_.back().lattice().finer());
    const uint64_t brickIndices = finer.total();
    return 2 * brickIndices +
           Signs<D>::memoryToFill(brickIndices, mostRefinedBricks(signs_.back(), finer)) +
           Signs<D>::memoryToFill(brickIndices, uint64_t{absent_.back().brickCount()} << D);
  }
  /// The same to fill an octave: vertices that were absent may need bricks of their own, on finer
  /// octaves, too.
  [[nodiscard]] uint64_t memoryToFill(int level) const {
    uint64_t sum = 0;
    for (auto o = static_cast<std::size_t>(level); o < signs_.size(); ++o) {
      sum += Signs<D>::memoryToFill(signs_[o].table().total(),
                                    uint64_t{signs_[o].brickCount()} + absent_[o].brickCount());
    }
    return sum;
  }

  template <CodecExchange<D> Exchange>
  void base(Exchange& exchange) {
    BaseCoder<D>().code(exchange, signs_.front());
  }

  /// The next octave: which crossing cells stay whole, and the signs of the new vertices of the
  /// others.
  template <CodecExchange<D> Exchange>
  ISOSTAR_COLD void refine(Exchange& exchange) {
    Signs<D> fine = refined(signs_.back()), absent = inherited(absent_.back());
    coders_->refinement.code(exchange, fine, &absent);
    if (exchange.exhausted()) return;  // the octave stays as it was
    signs_.push_back(std::move(fine));
    absent_.push_back(std::move(absent));
  }

  /// The base and all octaves at once; what shows is only the whole.
  template <CodecExchange<D> Exchange>
  ISOSTAR_COLD void codeAll(Exchange& exchange, int finestLevel) {
    exchange.enter(0);
    base(exchange);
    for (int level = 1; level <= finestLevel; ++level) {
      exchange.hold(memory());
      if (!exchange.charge(memoryToRefine())) return;
      exchange.enter(level);
      refine(exchange);
    }
  }

  /// The absent vertices of an octave, those of coarser ones being there: the reverse of the welds
  /// that made them absent.
  template <CodecExchange<D> Exchange>
  ISOSTAR_COLD void fill(Exchange& exchange, int level) {
    auto& signs = signs_[static_cast<std::size_t>(level)];
    auto& absent = absent_[static_cast<std::size_t>(level)];
    forEachMember(absent, [&](const Coordinates<D>& v) {
      auto corner = v;
      for (int a = 0; a < D; ++a) corner[a] -= signs.lattice().isNew(a, v[a]) ? 1 : 0;
      signs.set(v, signs.at(corner));
    });
    exchange.hold(memory());
    for (int dimension = D; dimension >= 1; --dimension)
      coders_->filling.code(exchange, signs, dimension, absent);
    if (exchange.exhausted()) return;
    absent = Signs<D>(signs.lattice());
    for (int finer = level + 1; finer <= this->level(); ++finer) takeOverFilled(finer);
  }

  /// The signs of the finest octave; the mesh is of no use any more.
  [[nodiscard]] Signs<D> takeSigns() { return std::move(signs_.back()); }

 private:
  /// The absent vertices of a coarser octave on the next one's lattice.
  static Signs<D> inherited(const Signs<D>& coarse) {
    Signs<D> fine(coarse.lattice().finer());
    forEachMember(coarse,
                  [&](const Coordinates<D>& v) { fine.set(coarse.lattice().onFiner(v), true); });
    return fine;
  }

  /// Vertices that are no longer absent on the coarser octave are there, too.
  ISOSTAR_COLD void takeOverFilled(int level) {
    auto& signs = signs_[static_cast<std::size_t>(level)];
    auto& absent = absent_[static_cast<std::size_t>(level)];
    forEachMember(absent, [&](const Coordinates<D>& v) {
      const auto same = signs.lattice().onCoarser(v);
      if (!same || this->absent(level - 1).at(*same)) return;
      signs.set(v, this->signs(level - 1).at(*same));
      absent.set(v, false);
    });
  }

  std::vector<Signs<D>> signs_, absent_;  // by octave, as they were told
  struct Coders {
    RefinementCoder<D> refinement;
    FillingCoder<D> filling;
  };
  std::optional<Coders> coders_;  // with models of some megabytes
};

}  // namespace isostar
