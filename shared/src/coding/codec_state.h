// A stream's layers as one traversal for both directions: the encoder tells, the decoder listens.
#pragma once

#include "coding/adaptive/adaptive_field.h"
#include "coding/isovalues/further_isovalues.h"
#include "coding/geometry/displacement_coder.h"
#include "coding/geometry/domain_coder.h"
#include "coding/geometry/geometry_pass.h"
#include "coding/geometry/magnitude_coder.h"
#include "estimate/hints.h"
#include "grid/refined_signs.h"
#include "coding/geometry/exponent_coder.h"
#include "coding/signs/refinement_coder.h"
#include "util/cold_path.h"
#include "container/stream.h"

namespace isostar {

/// All that both sides know, and the models that carry over from layer to layer.
template <int D>
struct Knowledge {
  /// The header outlives it.
  explicit Knowledge(const Header& h) : header(h), signs(h.base<D>()), level(0) {}

  template <class Exchange>
  void base(Exchange& ask) {
    if (header.keepsTopology && header.octaves() > 0) {
      partial.emplace(header.base<D>());
      partial->mesh.tellAll(ask, header.octaves());
    } else {
      BaseCoder<D>().tell(ask, signs);
    }
  }

  template <class Exchange>
  void refine(Exchange& ask) {
    const Kernel shown = tellKernel(ask);
    if (partial) return fill(ask, shown);
    Signs<D> finer = refined(signs);
    refinement.tell(ask, finer);
    if (ask.spent()) {  // the octave stays as it was
      unfinished = std::move(finer);
      unfinishedKernel = shown;
      return;
    }
    signs = std::move(finer);
    kernel = shown;
    displacements = {};
    active = {};
    ++level;
  }

  /// Which kernel places the octave's surface best.
  template <class Exchange>
  [[nodiscard]] ISOSTAR_SELDOM Kernel tellKernel(Exchange& ask) {
    const Kernel truth = ask.kernel();
    if (kernelModel[0].bit(ask.coder(), truth == Kernel::Narrow)) return Kernel::Narrow;
    return kernelModel[1].bit(ask.coder(), truth == Kernel::Middle) ? Kernel::Middle : Kernel::Wide;
  }

  /// The next octave of a mesh that has been welded as far as the topology allows.
  template <class Exchange>
  void fill(Exchange& ask, Kernel shown) {
    partial->mesh.fill(ask, level + 1);
    if (ask.spent()) return;
    kernel = shown;  // of the finest octave; before it the mesh is shown as its topology was planned
    if (++level < header.octaves()) return;
    signs = partial->mesh.takeSigns();
    partial.reset();
  }

  /// Takes an octave that has been told in part, the stream being at its end, for what it is.
  ISOSTAR_SELDOM void keepUnfinished() {
    if (!refinement.began()) return;
    Signs<D> untold = refinement.untold(unfinished);
    partial.emplace(std::move(signs), std::move(unfinished), std::move(untold));
    partial->kernel = unfinishedKernel;
    partial->coarserKernel = kernel;
    partial->coarserDisplacements = std::move(displacements);
    displacements = {};
  }
  /// Bytes that this takes at most.
  [[nodiscard]] uint64_t memoryToKeepUnfinished() const {
    const std::size_t places = unfinished.table().total();
    return memory() + unfinished.memory() + Signs<D>::memoryToFill(places, places);
  }

  /// Where displacements and scalars may be told: the last refinement knows, if there was one.
  void findActive() {
    active = refinement.takeActive();
    if (active.size() != signs.table().total()) active = activeBricks(signs);
  }

  /// Where the domain ends, near the finest octave's surface.
  template <class Exchange>
  ISOSTAR_SELDOM void tellDomain(Exchange& ask) {
    findActive();
    domain = Scalars<D>(active.size());
    DomainCoder<D>(header.domainReach()).tell(ask, signs, active, header.polygonizer == Polygonizer::Tetrahedra, domain);
  }

  template <class Exchange>
  void geometry(Exchange& ask, const GeometryPass<D>& pass) {
    if (active.empty()) findActive();
    if (pass.kind == LayerKind::Displacement) {
      if (displacements.places() == 0) displacements = Displacements<D>(active.size());
      displacing.tell(ask, signs, displacements, pass.displacement, active);
      return;
    }
    if (scalars.places() == 0) scalars = Scalars<D>(active.size());
    if (pass.kind == LayerKind::Octaves) {
      told[static_cast<std::size_t>(pass.members)] = true;
      octaves.tell(ask, signs, scalars, pass.members, pass.depth, active, hints());
    } else {
      halvings.tell(ask, signs, scalars, pass.halving(header.fitted), active);
      halved = halved || !ask.spent();
    }
  }

  /// The signs of a further isovalue, by number from 1.
  template <class Exchange>
  void nearSigns(Exchange& ask, int number) {
    const double isovalue = header.near[static_cast<std::size_t>(number) - 1];
    near.signs(ask, first(), isovalue, header.shift(isovalue), header.shiftError());
  }

  /// Of the isovalue whose signs have been told last.
  template <class Exchange>
  void nearGeometry(Exchange& ask, const GeometryPass<D>& pass) {
    if (pass.kind == LayerKind::Octaves) near.octaves(ask, pass.members, pass.depth);
    else near.halvings(ask, pass.halving(false));
  }

  /// Of the octave that is known, of the first isovalue.
  [[nodiscard]] Hints<D> hints() const { return {kernel, &displacements}; }
  [[nodiscard]] typename CloseBy<D>::First first() const { return {header.isovalue, signs, scalars}; }

  /// Bytes in use beside the models, while one more brick is made.
  [[nodiscard]] uint64_t memory() const { return memoryBesideScalars() + scalars.memory(); }
  [[nodiscard]] uint64_t memoryBesideScalars() const {
    return signs.memory() + unfinished.memory() + refinement.memory() + active.capacity() + (partial ? partial->memory() : 0) +
           (domain.places() != 0 ? domain.memory() : 0) + displacements.memory();
  }
  /// What it takes to begin the first geometry layer, or the domain's, or to go on.
  [[nodiscard]] uint64_t memoryForScalars() const {
    const std::size_t places = signs.table().total();
    return memory() + memoryToFindActive() + (scalars.places() == 0 ? Scalars<D>::memoryOf(places, 1) : 0);
  }
  /// The same for displacements.
  [[nodiscard]] uint64_t memoryForDisplacements() const {
    return memory() + memoryToFindActive() + (displacements.places() == 0 ? Displacements<D>::memoryToBegin(signs.table().total()) : 0);
  }
  [[nodiscard]] uint64_t memoryToFindActive() const { return active.empty() ? signs.table().total() : 0; }
  /// What it takes at most to begin the next octave: both octaves' signs, a mark for each place.
  [[nodiscard]] uint64_t memoryToRefine() const {
    if (partial) return memoryBesideScalars() + partial->mesh.memoryToFill(level + 1);
    const BrickTable<D> finer(signs.lattice().finer());
    return memoryBesideScalars() + finer.total() + Signs<D>::memoryToFill(finer.total(), mostRefinedBricks(signs, finer));
  }

  const Header& header;
  Signs<D> signs;
  Kernel kernel = Kernel::Narrow;  // of the octave that is known
  int level;
  /// Instead of the signs: of a stream that keeps the topology, before its finest octave; and of one that ends within an octave.
  std::optional<AdaptiveField<D>> partial;
  Signs<D> unfinished;  // of an octave that has been told in part
  Kernel unfinishedKernel = Kernel::Narrow;
  std::array<Chance, 2> kernelModel;
  RefinementCoder<D> refinement;
  std::vector<uint8_t> active;  // bricks of the octave that is known; empty before its displacements, its scalars or the domain are told
  Displacements<D> displacements;  // of the octave that is known
  Scalars<D> scalars;
  Scalars<D> domain;  // of a trimmed stream: see DomainCoder
  bool halved = false;          // has a pass that halves intervals been told?
  std::array<bool, 2> told{};  // by Members: have their scalars been told, if perhaps not all of them?
  DisplacementCoder<D> displacing;
  OctavesCoder<D> octaves;
  HalvingCoder<D> halvings;
  CloseBy<D> near;
};

}  // namespace isostar
