// The layers of a stream as one traversal for both directions.
#pragma once

#include "coding/adaptive/coarser_levels.h"
#include "coding/geometry/domain_coder.h"
#include "coding/geometry_state.h"
#include "coding/rare_state.h"
#include "coding/signs/refinement_coder.h"
#include "container/stream.h"
#include "grid/refined_signs.h"
#include "util/cold_path.h"

namespace isostar {

/// All that encoder and decoder share, and the bit models that persist from layer to layer.
template <int D>
struct CodecState : GeometryState<D> {
  using GeometryState<D>::active;
  using GeometryState<D>::displacements;
  using GeometryState<D>::scalars;

  /// The header must outlive it.
  explicit CodecState(const Header& h) : header(h), signs(h.base<D>()), level(0) {}

  /// Codes one layer. `pass`: for kinds that have one.
  template <CodecExchange<D> Exchange>
  void code(Exchange& exchange, const LayerHead& head, const GeometryPass<D>& pass = {}) {
    switch (head.kind) {
      case LayerKind::Base:
        return base(exchange);
      case LayerKind::Refinement:
        return refine(exchange);
      case LayerKind::Domain:
      case LayerKind::FurtherSigns:
      case LayerKind::FurtherGeometry:
        if constexpr (kDecodesAll) codeRare(exchange, head, pass);
        return;
      default:
        return geometry(exchange, pass);
    }
  }

  /// `needed`: bytes that a layer needs at most to begin. `fixed`: bytes in use that do not change
  /// while it is decoded.
  struct Memory {
    uint64_t needed, fixed;
  };
  [[nodiscard]] Memory memoryFor(LayerKind layer, LayerKind pass) const {
    if constexpr (kDecodesAll) {
      if (traitsOf(layer).isFurther) return memoryForFurther(layer, pass);
    }
    switch (layer) {
      case LayerKind::Refinement:
        return {memoryToRefine(), memoryBesideScalars()};
      case LayerKind::Displacement:
        return {memoryForDisplacements(), memory() - displacements.memory() + memoryToFindActive()};
      default:
        return {memoryForScalars(), memoryBesideScalars() + memoryToFindActive()};
    }
  }

  /// The layers of further isovalues.
  [[nodiscard]] Memory memoryForFurther(LayerKind layer, LayerKind pass) const {
    const auto& further = rare.further;
    const uint64_t all = memory() + further.memory();
    if (layer == LayerKind::FurtherSigns)
      return {all + further.memoryToBegin(first()),
              all - further.memoryOfIntervals() + signs.table().total()};
    return {all + (pass == LayerKind::Exponents ? further.memoryToCode() : 0), 0};
  }

  /// Codes a layer that only RareState has the state of.
  template <CodecExchange<D> Exchange>
  void codeRare(Exchange& exchange, const LayerHead& head, const GeometryPass<D>& pass) {
    if (head.kind == LayerKind::Domain) return codeDomain(exchange);
    if (head.kind == LayerKind::FurtherSigns) return furtherSigns(exchange, head.level);
    furtherGeometry(exchange, pass);
  }

  template <CodecExchange<D> Exchange>
  void base(Exchange& exchange) {
    if constexpr (kDecodesAll) {
      if (header.keepsTopology && header.finestLevel() > 0) {
        rare.partial.emplace(header.base<D>());
        return rare.partial->mesh.codeAll(exchange, header.finestLevel());
      }
    }
    BaseCoder<D>().code(exchange, signs);
  }

  template <CodecExchange<D> Exchange>
  void refine(Exchange& exchange) {
    const SmoothingFilter shown = codeFilter(exchange);
    if constexpr (kDecodesAll) {
      if (rare.partial) return fill(exchange, shown);
    }
    Signs<D> finer = refined(signs);
    refinement.code(exchange, finer);
    if (exchange.exhausted()) {  // the level does not change
      unfinished = std::move(finer);
      unfinishedFilter = shown;
      return;
    }
    enterLevel(std::move(finer), shown);
    ++level;
  }

  /// Shows the next level; the caller counts it when it is complete. `absent`: its new vertices
  /// near the surface whose signs are not known, and those that the level before lacks; none unless
  /// the stream or the caller's choice ends in the level.
  void enterLevel(Signs<D> finer, SmoothingFilter shown, std::optional<Signs<D>> absent = {}) {
    if (absent)
      coarser.push(std::move(signs), filter, std::move(displacements), *std::move(absent));
    signs = std::move(finer);
    filter = shown;
    displacements = {};
    active = {};
  }

  /// Codes which smoothing filter locates the level's surface best.
  template <CodecExchange<D> Exchange>
  [[nodiscard]] ISOSTAR_COLD SmoothingFilter codeFilter(Exchange& exchange) {
    const SmoothingFilter actual = exchange.filter();
    if (filterModel[0].bit(exchange.coder(), actual == SmoothingFilter::Narrow))
      return SmoothingFilter::Narrow;
    return filterModel[1].bit(exchange.coder(), actual == SmoothingFilter::Middle)
               ? SmoothingFilter::Middle
               : SmoothingFilter::Wide;
  }

  /// Fills the next level of a mesh that was welded as far as the topology allows.
  template <CodecExchange<D> Exchange>
  void fill(Exchange& exchange, SmoothingFilter shown) {
    rare.partial->mesh.fill(exchange, level + 1);
    if (exchange.exhausted()) return;
    // Used on the finest level only: coarser ones must be shown exactly as the topology plan has
    // checked them.
    filter = shown;
    if (++level < header.finestLevel()) return;
    signs = rare.partial->mesh.takeSigns();
    rare.partial.reset();
  }

  /// Shows a level of which only a part was decoded, at the end of a stream.
  ISOSTAR_COLD void keepUnfinished() {
    if (!refinement.began()) return;
    Signs<D> uncoded = refinement.uncoded(unfinished);
    enterLevel(std::move(unfinished), unfinishedFilter, std::move(uncoded));
  }
  /// Bytes needed at most for this.
  [[nodiscard]] uint64_t memoryToKeepUnfinished() const {
    const std::size_t tableSize = unfinished.table().total();
    return memory() + unfinished.memory() + Signs<D>::memoryToFill(tableSize, tableSize);
  }

  /// Finds the bricks in which displacements and scalars are coded. The last refinement already
  /// knows them.
  void findActive() {
    active = refinement.takeActive();
    if (active.size() != signs.table().total()) active = activeBricks(signs);
  }

  /// Codes where the domain ends near the finest level's surface.
  template <CodecExchange<D> Exchange>
  ISOSTAR_COLD void codeDomain(Exchange& exchange) {
    findActive();
    rare.domain = Scalars<D>(active.size());
    DomainCoder<D>(header.domainReach())
        .code(exchange, signs, active, header.polygonizer == Polygonizer::Tetrahedra, rare.domain);
  }

  template <CodecExchange<D> Exchange>
  void geometry(Exchange& exchange, const GeometryPass<D>& pass) {
    if (active.empty()) findActive();
    this->codePass(exchange, signs, pass, filter, header.fitted, &exponents);
  }

  /// Codes the signs of a further isovalue; numbers start at 1.
  template <CodecExchange<D> Exchange>
  void furtherSigns(Exchange& exchange, int number) {
    const double isovalue = header.furtherIsovalues[static_cast<std::size_t>(number) - 1];
    rare.further.signs(exchange, first(), isovalue, header.shift(isovalue), header.shiftError());
  }

  /// Codes geometry of the isovalue whose signs were coded last.
  template <CodecExchange<D> Exchange>
  void furtherGeometry(Exchange& exchange, const GeometryPass<D>& pass) {
    if (pass.kind == LayerKind::Exponents)
      rare.further.exponents(exchange, pass.members, pass.exponentRange);
    else
      rare.further.magnitudes(exchange, pass.magnitudePass(false));
  }

  /// For the first isovalue, on the last complete level.
  [[nodiscard]] Hints<D> hints() const { return {filter, &displacements}; }
  [[nodiscard]] typename FurtherIsovalues<D>::First first() const {
    return {header.isovalue, signs, scalars};
  }

  /// Bytes in use beside the models while one more brick is made.
  [[nodiscard]] uint64_t memory() const { return memoryBesideScalars() + scalars.memory(); }
  [[nodiscard]] uint64_t memoryBesideScalars() const {
    return signs.memory() + unfinished.memory() + refinement.memory() + active.capacity() +
           rare.memory() + displacements.memory() + (coarser.empty() ? 0 : coarser.memory());
  }
  /// Bytes needed to begin the first geometry or domain layer, or to continue.
  [[nodiscard]] uint64_t memoryForScalars() const {
    const std::size_t tableSize = signs.table().total();
    return memory() + memoryToFindActive() +
           (scalars.tableSize() == 0 ? Scalars<D>::memoryOf(tableSize, 1) : 0);
  }
  /// The same for displacements.
  [[nodiscard]] uint64_t memoryForDisplacements() const {
    return memory() + memoryToFindActive() +
           (displacements.tableSize() == 0 ? Displacements<D>::memoryOf(signs.table().total(), 1)
                                           : 0);
  }
  [[nodiscard]] uint64_t memoryToFindActive() const {
    return active.empty() ? signs.table().total() : 0;
  }
  /// Bytes needed at most to begin the next level: the signs of both levels, and one byte per brick
  /// index.
  [[nodiscard]] uint64_t memoryToRefine() const {
    if constexpr (kDecodesAll) {
      if (rare.partial) return memoryBesideScalars() + rare.partial->mesh.memoryToFill(level + 1);
    }
    return memoryBesideScalars() + BrickTable<D>(signs.lattice().finer()).total() +
           memoryOfRefined(signs);
  }

  const Header& header;
  Signs<D> signs;
  SmoothingFilter filter = SmoothingFilter::Narrow;  // of the last complete level
  int level;
  RareState<D> rare;
  CoarserLevels<D> coarser;  // below a last level that is known in parts
  Signs<D> unfinished;       // a level of which a part is coded
  SmoothingFilter unfinishedFilter = SmoothingFilter::Narrow;
  std::array<BitModel, 2> filterModel;
  RefinementCoder<D> refinement;
  ExponentCoder<D> exponents;
};

}  // namespace isostar
