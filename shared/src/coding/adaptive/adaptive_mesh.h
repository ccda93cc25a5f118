// An adaptive mesh of the RBMT (§4.3, §5.1, §5.2), coded level by level.
#pragma once

#include "coding/adaptive/adaptive_level.h"
#include "coding/signs/base_coder.h"
#include "coding/signs/filling_coder.h"
#include "coding/signs/refinement_coder.h"
#include "grid/refined_signs.h"
#include "util/cold_path.h"

namespace isostar {

/// An adaptive mesh is a sequence of whole levels with absent vertices. A crossing cell that is
/// kept lacks all vertices that would split it, and its neighbours lack those that depend on them.
template <int D>
class AdaptiveMesh {
 public:
  explicit AdaptiveMesh(const Lattice<D>& base)
      : signs_(1, Signs<D>(base)), absent_(1, Signs<D>(base)), coders_(std::in_place) {}

  [[nodiscard]] int level() const { return static_cast<int>(signs_.size()) - 1; }
  [[nodiscard]] const Signs<D>& signs(int level) const {
    return signs_[static_cast<std::size_t>(level)];
  }
  [[nodiscard]] const Signs<D>& absent(int level) const {
    return absent_[static_cast<std::size_t>(level)];
  }
  /// Is a vertex of a level in the mesh, and a vertex of a simplex that is not split further?
  [[nodiscard]] bool belongsToLeaf(int level, const Coordinates<D>& v) const {
    return isostar::belongsToLeaf<D>(absent(level),
                                     level < this->level() ? &absent(level + 1) : nullptr, v);
  }

  /// Bytes in use beside the models while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = coders_ ? coders_->refinement.memory() : 0;
    for (const auto& s : signs_) sum += s.memory();
    for (const auto& s : absent_) sum += s.memory();
    return sum;
  }
  /// Bytes needed at most, in addition, to begin the next level.
  [[nodiscard]] uint64_t memoryToRefine() const {
    const BrickTable<D> finer(signs_.back().lattice().finer());
    const uint64_t tableSize = finer.total();
    return 2 * tableSize + memoryOfRefined(signs_.back()) +
           Signs<D>::memoryToFill(tableSize, uint64_t{absent_.back().brickCount()} << D);
  }
  /// The same to fill a level. Vertices that were absent may need bricks of their own, on finer
  /// levels too.
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

  /// Codes the next level: which crossing cells are kept, and the signs of the other cells' new
  /// vertices.
  template <CodecExchange<D> Exchange>
  ISOSTAR_COLD void refine(Exchange& exchange) {
    Signs<D> fine = refined(signs_.back()), absent = onFinerLevel(absent_.back());
    coders_->refinement.code(exchange, fine, &absent);
    if (exchange.exhausted()) return;  // the level does not change
    signs_.push_back(std::move(fine));
    absent_.push_back(std::move(absent));
  }

  /// Codes the base and all levels as one layer, which can be shown only as a whole.
  template <CodecExchange<D> Exchange>
  ISOSTAR_COLD void codeAll(Exchange& exchange, int finestLevel) {
    exchange.enterLevel(0);
    base(exchange);
    for (int level = 1; level <= finestLevel; ++level) {
      exchange.hold(memory());
      if (!exchange.charge(memoryToRefine())) return;
      exchange.enterLevel(level);
      refine(exchange);
    }
  }

  /// Codes the absent vertices of a level; coarser levels have no absent ones any more. This
  /// reverses the welds that made them absent.
  template <CodecExchange<D> Exchange>
  ISOSTAR_COLD void fill(Exchange& exchange, int level) {
    auto& signs = signs_[static_cast<std::size_t>(level)];
    auto& absent = absent_[static_cast<std::size_t>(level)];
    for (int finer = level; finer <= this->level(); ++finer)
      exchange.visit(countMembers(this->absent(finer)) / 4);
    forEachMember(absent, [&](const Coordinates<D>& v) {
      auto corner = v;
      for (int a = 0; a < D; ++a) corner[a] -= signs.lattice().isNew(a, v[a]) ? 1 : 0;
      signs.set(v, signs.at(corner));
    });
    exchange.hold(memory());
    for (int newAxisCount = D; newAxisCount >= 1; --newAxisCount)
      coders_->filling.code(exchange, signs, newAxisCount, absent);
    if (exchange.exhausted()) return;
    absent = Signs<D>(signs.lattice());
    for (int finer = level + 1; finer <= this->level(); ++finer) takeOverFilled(finer);
  }

  /// Moves the finest level's signs out. The mesh must not be used afterwards.
  [[nodiscard]] Signs<D> takeSigns() { return std::move(signs_.back()); }

 private:
  /// Vertices that are no longer absent on the coarser level are not absent here either.
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

  std::vector<Signs<D>> signs_, absent_;  // by level, as coded
  struct Coders {
    RefinementCoder<D> refinement;
    FillingCoder<D> filling;
  };
  std::optional<Coders> coders_;  // its models take some megabytes
};

}  // namespace isostar
