// The levels below one that is known in parts only.
#pragma once

#include <optional>

#include "coding/adaptive/adaptive_level.h"
#include "scalars/displacements.h"
#include "util/cold_path.h"

namespace isostar {

/// Where the last level lacks vertices, the surface is that of the level before: an absent vertex
/// lies halfway along the edge that it would split, as in an adaptive mesh, and there are no
/// cracks.
template <int D>
class CoarserLevels {
 public:
  /// The last level has all its vertices.
  [[nodiscard]] bool empty() const { return levels_.empty(); }
  /// The absent vertices of the last level; not if empty().
  [[nodiscard]] const Signs<D>& absent() const { return absent_; }

  /// Keeps a level when the next one is entered. `absent`: the next one's absent vertices.
  ISOSTAR_COLD void push(Signs<D> signs, SmoothingFilter filter, Displacements<D> displacements,
                         Signs<D> absent) {
    if (empty()) absent_ = Signs<D>(signs.lattice());
    levels_.push_back({std::move(signs), std::move(absent_), filter, std::move(displacements)});
    absent_ = std::move(absent);
  }

  /// The last level, completed with estimates. `signs`: its signs; those of absent vertices do not
  /// matter. `known`: its scalars, in a unit that has room for all coarser levels. Nothing if that
  /// takes more than `memory` bytes.
  [[nodiscard]] ISOSTAR_COLD std::optional<AdaptiveLevel<D>> completed(const Signs<D>& signs,
                                                                       const Hints<D>& hints,
                                                                       const KnownScalars<D>& known,
                                                                       uint64_t memory) const {
    const int gradient = known.scalars.meanGradient(kPlainGradient);
    AdaptiveLevel<D> shown;
    for (std::size_t i = 0; i <= levels_.size(); ++i) {
      const bool isLast = i == levels_.size();
      const Signs<D>& own = isLast ? signs : levels_[i].signs;
      const Signs<D>& absent = isLast ? absent_ : levels_[i].absent;
      const auto* coarser = i == 0 ? nullptr : &shown;
      if (shown.memory() + AdaptiveLevel<D>::memoryToMake(own, absent, coarser) > memory)
        return std::nullopt;
      AdaptiveLevel<D> next(own, absent, coarser);
      if (isLast) next.take(known.scalars);
      shown = std::move(next);
      if (shown.memoryToEstimate() > memory) return std::nullopt;
      shown.estimate(absent, isLast ? nullptr : &absentAfter(i),
                     known.finer + static_cast<int>(levels_.size() - i),
                     isLast ? hints : Hints<D>{levels_[i].filter, &levels_[i].displacements},
                     gradient);
    }
    return shown;
  }
  /// How many levels these are.
  [[nodiscard]] int count() const { return static_cast<int>(levels_.size()); }

  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = absent_.memory();
    for (const auto& level : levels_)
      sum += level.signs.memory() + level.absent.memory() + level.displacements.memory();
    return sum;
  }

 private:
  struct Level {
    Signs<D> signs, absent;
    SmoothingFilter filter;
    Displacements<D> displacements;
  };
  [[nodiscard]] const Signs<D>& absentAfter(std::size_t i) const {
    return i + 1 < levels_.size() ? levels_[i + 1].absent : absent_;
  }

  std::vector<Level> levels_;
  Signs<D> absent_;
};

}  // namespace isostar
