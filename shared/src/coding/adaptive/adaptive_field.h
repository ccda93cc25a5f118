// The field on an adaptive mesh (§5.3): codes the scalars of its leaves level by level, and
// completes them for display.
#pragma once

#include "coding/adaptive/adaptive_level.h"
#include "coding/adaptive/adaptive_mesh.h"
#include "coding/geometry/exponent_coder.h"
#include "coding/geometry/geometry_pass.h"
#include "coding/geometry/magnitude_coder.h"
#include "estimate/completion.h"

namespace isostar {

/// An absent vertex lies halfway along the refinement edge that it would split, and its scalar is
/// the mean of the edge's ends. So the field is the piecewise linear one of the leaves, on
/// whichever level it is polygonized, and the surface has no cracks.
template <int D>
class AdaptiveField {
 public:
  explicit AdaptiveField(const Lattice<D>& base) : mesh(base) {}
  /// A level that is only partly coded; parameters as of AdaptiveMesh.
  AdaptiveField(Signs<D> coarse, Signs<D> fine, Signs<D> absent)
      : mesh(std::move(coarse), std::move(fine), std::move(absent)) {}

  AdaptiveMesh<D> mesh;
  /// Of the level before the last one, used where no scalars are known.
  Displacements<D> coarserDisplacements;
  /// `filter` locates the last level's surface where no scalars are known, `coarserFilter` that of
  /// the others.
  SmoothingFilter filter = SmoothingFilter::Middle, coarserFilter = SmoothingFilter::Middle;

  /// The number of levels whose scalars are coded.
  [[nodiscard]] int codedLevels() const { return static_cast<int>(levels_.size()); }
  [[nodiscard]] const AdaptiveLevel<D>& at(int level) const {
    return levels_[static_cast<std::size_t>(level)];
  }

  /// Codes one layer of an adaptive stream.
  template <CodecExchange<D> Exchange>
  void code(Exchange& exchange, const GeometryPass<D>& pass, const Header& header) {
    switch (pass.kind) {
      case LayerKind::Base:
        return mesh.base(exchange);
      case LayerKind::Refinement:
        return mesh.refine(exchange);
      case LayerKind::Exponents:
        return codeExponents(exchange, pass.exponentRange, header.polygonizer);
      default:
        return codeMagnitudes(exchange, pass.magnitudePass(header.fitted));
    }
  }

  /// Bytes in use beside the models while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = mesh.memory() + coarserDisplacements.memory();
    for (const auto& o : levels_) sum += o.memory();
    return sum;
  }
  /// Bytes needed at most, in addition, to begin the next level's scalars.
  [[nodiscard]] uint64_t memoryToCode() const {
    return codedLevels() > mesh.level() ? 0 : memoryForNext(last(), codedLevels());
  }

  /// Codes the exponents of the next level: of those vertices of its leaves whose scalars no
  /// coarser level has coded. On the finest level, Polygonizer::Cubes does not need the ends of
  /// diagonals.
  template <CodecExchange<D> Exchange>
  void codeExponents(Exchange& exchange, int exponentRange, Polygonizer polygonizer) {
    const int level = codedLevels();
    levels_.push_back(next(last(), level));
    if (!coders_) coders_.emplace();
    auto& adaptive = levels_.back();
    coders_->exponents.code(
        exchange, adaptive.signs, adaptive.scalars, Members::AxisEnds, exponentRange,
        adaptive.active, [&](Tube<D>& tube) {
          if (level < mesh.level() || polygonizer == Polygonizer::Tetrahedra)
            tube.addDiagonalEnds(adaptive.signs);
          const auto& known = adaptive.scalars.at(tube.table().index(tube.at()));
          tube.keepOnly([&](std::size_t r, int x) {
            const std::size_t i = r * kBrickSide + static_cast<std::size_t>(x);
            return !known.knows(i) && mesh.belongsToLeaf(level, vertexOf<D>(tube.at(), i));
          });
        });
  }
  template <CodecExchange<D> Exchange>
  void codeMagnitudes(Exchange& exchange, const typename MagnitudeCoder<D>::Pass& pass) {
    auto& adaptive = levels_.back();
    coders_->magnitudes.code(exchange, adaptive.signs, adaptive.scalars, pass, adaptive.active);
  }

  /// A level as far as it is known, completed with estimates. Nothing if that takes more than
  /// `memory` bytes.
  [[nodiscard]] ISOSTAR_COLD std::optional<AdaptiveLevel<D>> shown(
      int level, uint64_t memory = UINT64_MAX) const {
    AdaptiveLevel<D> adaptive;
    for (int o = std::max(codedLevels() - 1, 0); o <= level; ++o) {
      const auto* coarser = o == 0 ? nullptr : &adaptive;
      const uint64_t made = o < codedLevels() ? at(o).memory() : memoryForNext(coarser, o);
      if (adaptive.memory() + made > memory) return std::nullopt;
      if (o < codedLevels())
        adaptive = at(o);
      else
        adaptive = next(coarser, o);
      // The known bricks are copied while the missing scalars are estimated.
      const auto bricks =
          adaptive.scalars.brickCount() +
          static_cast<std::size_t>(std::count(adaptive.active.begin(), adaptive.active.end(), 1));
      if (adaptive.memory() + 2 * Scalars<D>::memoryOf(adaptive.active.size(), bricks) > memory)
        return std::nullopt;
      estimate(o, codedLevels() == 0 ? level - o : 0, adaptive);
    }
    return adaptive;
  }

 private:
  [[nodiscard]] const AdaptiveLevel<D>* last() const {
    return levels_.empty() ? nullptr : &levels_.back();
  }
  [[nodiscard]] AdaptiveLevel<D> next(const AdaptiveLevel<D>* coarser, int level) const {
    return {mesh.signs(level), mesh.absent(level), coarser};
  }
  [[nodiscard]] uint64_t memoryForNext(const AdaptiveLevel<D>* coarser, int level) const {
    return AdaptiveLevel<D>::memoryToMake(mesh.signs(level), mesh.absent(level), coarser);
  }

  /// Estimates the missing scalars of a level's leaves. Values are 2^finer times as large: a coarse
  /// level's are multiplied by the ratio of its grid step to that of the last level. Vertices of
  /// other leaves are estimated better on finer levels.
  ISOSTAR_COLD void estimate(int level, int finer, AdaptiveLevel<D>& adaptive) const {
    const Scalars<D> before = adaptive.scalars;
    const Hints<D> hints =
        level == mesh.level()
            ? Hints<D>{filter}
            : Hints<D>{coarserFilter, level + 1 == mesh.level() ? &coarserDisplacements : nullptr};
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds})
      estimateMissing(adaptive.signs, adaptive.active, members, finer, adaptive.scalars, hints);
    if (level == mesh.level()) return;
    const auto& table = adaptive.signs.table();
    for (std::size_t brickIndex = 0; brickIndex < table.total(); ++brickIndex) {
      if (!adaptive.scalars.has(brickIndex)) continue;
      auto& brick = adaptive.scalars.writable(brickIndex);
      for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
        if (!brick.knows(i) || before.at(brickIndex).knows(i) ||
            mesh.belongsToLeaf(level, vertexOf<D>(table.brick(brickIndex), i)))
          continue;
        brick.value[i] = Scalars<D>::kUnknown;
      }
    }
  }

  std::vector<AdaptiveLevel<D>> levels_;
  struct Coders {
    ExponentCoder<D> exponents;
    MagnitudeCoder<D> magnitudes;
  };
  std::optional<Coders> coders_;  // set when the first scalars are coded
};

}  // namespace isostar
