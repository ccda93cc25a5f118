// The field on an adaptive mesh (§5.3): the scalars of its leaves, octave by octave, for both
// directions, and what is shown of it.
#pragma once

#include "coding/adaptive/adaptive_level.h"
#include "coding/adaptive/adaptive_mesh.h"
#include "coding/geometry/exponent_coder.h"
#include "coding/geometry/geometry_pass.h"
#include "coding/geometry/magnitude_coder.h"
#include "estimate/completion.h"

namespace isostar {

/// An absent vertex lies on the refinement edge that it would split, halfway, and so does its
/// scalar: the field is the piecewise linear one of the leaves, whatever octave it is looked at,
/// and no polygonizer can find a crack.
template <int D>
class AdaptiveField {
 public:
  explicit AdaptiveField(const Lattice<D>& base) : mesh(base) {}
  /// Of an octave that has been told in part, as AdaptiveMesh.
  AdaptiveField(Signs<D> coarse, Signs<D> fine, Signs<D> absent)
      : mesh(std::move(coarse), std::move(fine), std::move(absent)) {}

  AdaptiveMesh<D> mesh;
  Displacements<D>
      coarserDisplacements;  // of the octave before the last one, where no scalars are known
  SmoothingFilter filter = SmoothingFilter::Middle,
                  coarserFilter = SmoothingFilter::Middle;  // place the last octave's surface where
                                                            // no scalars are known, and others'

  /// Octaves whose scalars have been told.
  [[nodiscard]] int coded() const { return static_cast<int>(levels_.size()); }
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

  /// Bytes in use beside the models, while one more brick is made.
  [[nodiscard]] uint64_t memory() const {
    uint64_t sum = mesh.memory() + coarserDisplacements.memory();
    for (const auto& o : levels_) sum += o.memory();
    return sum;
  }
  /// What it takes at most, on top of that, to begin the next octave's scalars.
  [[nodiscard]] uint64_t memoryToCode() const {
    return coded() > mesh.level() ? 0 : memoryForNext(last(), coded());
  }

  /// Scalars of an octave: of the vertices of its leaves that coarser ones have not told. On the
  /// finest, `cubes` needs no ends of diagonals.
  template <CodecExchange<D> Exchange>
  void codeExponents(Exchange& exchange, int exponentRange, Polygonizer polygonizer) {
    const int level = coded();
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

  /// The octave as it is known, with estimates where nothing has been told yet; nothing if that
  /// takes more bytes than given.
  [[nodiscard]] ISOSTAR_COLD std::optional<AdaptiveLevel<D>> shown(
      int level, uint64_t memory = UINT64_MAX) const {
    AdaptiveLevel<D> adaptive;
    for (int o = std::max(coded() - 1, 0); o <= level; ++o) {
      const auto* coarser = o == 0 ? nullptr : &adaptive;
      const uint64_t made = o < coded() ? at(o).memory() : memoryForNext(coarser, o);
      if (adaptive.memory() + made > memory) return std::nullopt;
      if (o < coded())
        adaptive = at(o);
      else
        adaptive = next(coarser, o);
      // Those known are copied while the others are estimated.
      const auto bricks =
          adaptive.scalars.brickCount() +
          static_cast<std::size_t>(std::count(adaptive.active.begin(), adaptive.active.end(), 1));
      if (adaptive.memory() + 2 * Scalars<D>::memoryOf(adaptive.active.size(), bricks) > memory)
        return std::nullopt;
      estimate(o, coded() == 0 ? level - o : 0, adaptive);
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

  /// Gives the vertices of an octave's leaves values, as many times larger as its steps are longer:
  /// those of other vertices are better estimated on finer octaves.
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
  std::optional<Coders> coders_;  // once scalars are told
};

}  // namespace isostar
