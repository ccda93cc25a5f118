// The exchange of a GateTraversal: its encoder's and its decoder's side.
#pragma once

#include <vector>

#include "bisection/leaf_set.h"
#include "bisection/leaves.h"
#include "entropy/range_coder.h"

namespace isostar {

/// The encoder's side answers from a mesh and the source's signs.
template <int D, class Coder>
class MeshEncoderSide {
 public:
  /// `signs`: of all samples of the box.
  MeshEncoderSide(Coder& coder, const Rbmt<D>& mesh, const Signs<D>& signs)
      : coder_(coder), mesh_(mesh), signs_(signs) {
    forEachCrossingLeaf(mesh, signs, [&](const TaggedSimplex<D>& leaf) { tube_.push_back(leaf); });
  }

  Coder& coder() { return coder_; }
  [[nodiscard]] bool exhausted() const { return false; }
  [[nodiscard]] bool contains(const Coordinates<D>& v) const { return mesh_.contains(v); }
  [[nodiscard]] bool positive(const Coordinates<D>& sample) const { return signs_.at(sample); }
  /// The first crossing leaf, in the order of forEachLeaf, that has not been visited. A visited
  /// leaf must stay visited.
  [[nodiscard]] std::optional<TaggedSimplex<D>> nextSeed(const LeafSet<D>& visited) {
    while (next_ < tube_.size() && visited.has(tube_[next_])) ++next_;
    return next_ < tube_.size() ? std::optional(tube_[next_]) : std::nullopt;
  }

 private:
  Coder& coder_;
  const Rbmt<D>& mesh_;
  const Signs<D>& signs_;
  std::vector<TaggedSimplex<D>> tube_;
  std::size_t next_ = 0;
};

/// The decoder's side has no mesh; its answers are ignored.
template <int D>
class MeshDecoderSide {
 public:
  /// exhausted() becomes true after `slack` bytes beyond the end.
  MeshDecoderSide(RangeDecoder& coder, std::size_t slack) : coder_(coder), slack_(slack) {}

  RangeDecoder& coder() { return coder_; }
  [[nodiscard]] bool exhausted() const { return coder_.overrun() > slack_; }
  [[nodiscard]] bool contains(const Coordinates<D>&) const { return false; }
  [[nodiscard]] bool positive(const Coordinates<D>&) const { return false; }
  [[nodiscard]] std::optional<TaggedSimplex<D>> nextSeed(const LeafSet<D>&) const {
    return std::nullopt;
  }

 private:
  RangeDecoder& coder_;
  std::size_t slack_;
};

}  // namespace isostar
