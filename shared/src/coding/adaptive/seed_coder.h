// Localization (§5.1): codes the path through the hierarchy to the first leaf of a component, Left
// or Right at each bisection.
#pragma once

#include "bisection/adjacency.h"
#include "bisection/leaves.h"
#include "entropy/models.h"

namespace isostar {

/// Seeds come in the order of forEachLeaf. So while a path follows that of the last seed, it never
/// turns left of it.
template <int D>
class SeedCoder {
 public:
  explicit SeedCoder(const Hierarchy<D>& hierarchy) : hierarchy_(hierarchy) {
    forEachLeaf(Rbmt<D>(hierarchy), [&](const TaggedSimplex<D>& s) { base_.push_back(s); });
    for (std::size_t most = static_cast<std::size_t>(hierarchy.maxDepth()); most != 0; most >>= 1)
      ++depthBits_;
    depths_.resize(std::size_t{1} << depthBits_);
  }

  /// Does the box have no simplices, since it has no extent on some axis?
  [[nodiscard]] bool empty() const { return base_.empty(); }

  /// Codes the depth of the leaf, then the path to it. `actual` is empty on the decoder's side.
  /// Must not be called if empty().
  template <class Coder>
  TaggedSimplex<D> locate(Coder& coder, const std::optional<TaggedSimplex<D>>& actual) {
    const int depth = this->depth(coder, actual ? actual->depth : 0);
    std::vector<TaggedSimplex<D>> way;  // the actual path, from the leaf to the base
    if (actual) {
      way.push_back(*actual);
      while (way.back().depth > 0) way.push_back(parent(way.back()));
    }
    follows_ = true;
    turns_.clear();
    std::size_t first = 0, count = base_.size();
    const std::size_t at = actual ? number(way.back()) : 0;
    while (count > 1) {
      const std::size_t half = count / 2;
      const bool right = turn(coder, at >= first + half);
      first += right ? half : 0;
      count = right ? count - half : half;
    }
    auto s = base_[first];
    while (s.depth < depth) {
      const auto halves = s.halves();
      // If one half lies beyond the box, there is no decision.
      const bool onlyRight = hierarchy_.flat(halves[0].vertices),
                 onlyLeft = hierarchy_.flat(halves[1].vertices);
      const bool right = actual && way[static_cast<std::size_t>(depth - s.depth - 1)].vertices ==
                                       halves[1].vertices;
      s = halves[onlyRight || (!onlyLeft && turn(coder, right)) ? 1 : 0];
    }
    last_ = turns_;
    return s;
  }

 private:
  template <class Coder>
  int depth(Coder& coder, int actual) {
    std::size_t node = 1;
    for (int bit = depthBits_ - 1; bit >= 0; --bit)
      node = 2 * node + depths_[node].bit(coder, (actual >> bit & 1) != 0);
    return std::min(static_cast<int>(node - depths_.size()), hierarchy_.maxDepth());
  }

  template <class Coder>
  bool turn(Coder& coder, bool right) {
    const bool seen = follows_ && turns_.size() < last_.size(),
               before = seen && last_[turns_.size()];
    // There is no seed left of the last one.
    const bool taken = before || (seen ? leaves_ : free_).bit(coder, right);
    follows_ = seen && taken == before;
    turns_.push_back(taken);
    return taken;
  }

  [[nodiscard]] std::size_t number(const TaggedSimplex<D>& s) const {
    std::size_t at = 0;
    while (base_[at].vertices != s.vertices) ++at;
    return at;
  }

  Hierarchy<D> hierarchy_;
  std::vector<TaggedSimplex<D>> base_;
  std::vector<bool> turns_, last_;  // of this seed and of the last one
  bool follows_ = true;             // are all turns up to here those of the last seed?
  int depthBits_ = 0;
  std::vector<BitModel> depths_;  // a binary tree over the bits of a depth
  BitModel free_, leaves_;
};

}  // namespace isostar
