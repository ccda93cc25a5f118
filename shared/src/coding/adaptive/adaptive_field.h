// The field on an adaptive mesh (§5.3): codes the scalars of its leaves level by level, and
// completes them for display.
#pragma once

#include "coding/adaptive/adaptive_level.h"
#include "coding/adaptive/adaptive_mesh.h"
#include "coding/geometry/exponent_coder.h"
#include "coding/geometry/geometry_pass.h"
#include "coding/geometry/magnitude_coder.h"

namespace isostar {

/// An absent vertex lies halfway along the refinement edge that it would split, and its scalar is
/// the mean of the edge's ends. So the field is the piecewise linear one of the leaves, on
/// whichever level it is polygonized, and the surface has no cracks.
template <int D>
class AdaptiveField {
 public:
  explicit AdaptiveField(const Lattice<D>& base) : mesh(base) {}

  AdaptiveMesh<D> mesh;
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
    uint64_t sum = mesh.memory();
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
      if (adaptive.memoryToEstimate() > memory) return std::nullopt;
      adaptive.estimate(mesh.absent(o), o < mesh.level() ? &mesh.absent(o + 1) : nullptr,
                        codedLevels() == 0 ? level - o : 0);
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

  std::vector<AdaptiveLevel<D>> levels_;
  struct Coders {
    ExponentCoder<D> exponents;
    MagnitudeCoder<D> magnitudes;
  };
  std::optional<Coders> coders_;  // set when the first scalars are coded
};

}  // namespace isostar
