// The encoder's side of the traversal of a uniform stream: writes its layers.
#pragma once

#include <algorithm>
#include <array>

#include "coding/chunked_level.h"
#include "encoder/chunk_field.h"
#include "encoder/core/bound_check.h"
#include "encoder/core/chunk_order.h"
#include "encoder/core/coded_layers.h"
#include "encoder/core/displacement_plan.h"
#include "encoder/core/source.h"
#include "encoder/topology/encode_topology.h"
#include "isostar/isostar.h"
#include "util/run_all.h"

namespace isostar {

/// Writes layers one after the other.
template <int D>
class UniformWriter {
 public:
  UniformWriter(const Header& header, const EncodeOptions& options, Source<D>& first)
      : options_(options), finestLevel_(header.finestLevel()), source_(&first), state_(header) {
    check_.emplace(first.check());
  }

  /// Codes the signs of all levels. after(level) may code more layers on each level, except in
  /// streams that preserve the topology. `displaces`: whether displacementPlan() will be asked for
  /// on the finest level.
  template <class After>
  void signs(bool displaces, After after) {
    const Signs<D>& finest = source_->signs();
    std::vector<Signs<D>> coarse(static_cast<std::size_t>(finestLevel_));
    for (std::size_t level = coarse.size(); level-- > 0;)
      coarse[level] = coarsened(level + 1 < coarse.size() ? coarse[level + 1] : finest);
    std::vector<Signs<D>> whole;
    if constexpr (D == 3) {
      if (state_.header.keepsTopology) {
        coarse.push_back(finest);
        whole = wholeCells(state_.header, coarse);
      }
    }
    const SmoothingFilter filter = finestFilter();
    const auto codeLevel = [&](int level) {
      const Signs<D>& actual =
          level < finestLevel_ ? coarse[static_cast<std::size_t>(level)] : finest;
      const LayerHead head{.kind = level == 0 ? LayerKind::Base : LayerKind::Refinement,
                           .level = level};
      filter_ = filterOf(level, filter);
      code(head, actual, {}, [&](auto& exchange) {
        exchange.setLevels(coarse, whole);
        exchange.setFilter(filter_);
      });
      if (!state_.rare.partial) after(level);
    };
    // Coarse levels are coded one after the other, each by one task: meanwhile others plan.
    runAll(options_.runTasks, displaces ? 2 : 1, [&](std::size_t task) {
      if (task == 0) {
        for (int level = 0; level < finestLevel_; ++level) codeLevel(level);
      } else {
        finestPlan_.emplace(source_->field(), finest, source_->active(), filter, options_.runTasks);
      }
    });
    if (options_.progress) options_.progress(0.25);
    codeLevel(finestLevel_);
    if (options_.progress) options_.progress(0.5);
  }

  void domain() { code({.kind = LayerKind::Domain, .level = finestLevel_}, source_->signs()); }

  /// Codes the signs of a further isovalue. Later passes refer to it.
  void furtherSigns(int number, Source<D>& source) {
    number_ = number;
    source_ = &source;
    check_.emplace(source.check());
    code({.kind = LayerKind::FurtherSigns, .level = number}, source.signs());
  }

  void geometry(const GeometryPass<D>& pass) {
    source_->quantized().setRdoq(number_ == 0 && usesRdoq(pass));
    code({.kind = number_ == 0 ? pass.kind : LayerKind::FurtherGeometry,
          .level = number_ == 0 ? state_.level : number_},
         source_->signs(), pass);
  }

  /// Marks, by brick index, the bricks where a vertex of the surface is off by more than the bound.
  /// Empty if there are none. `changed`: what the passes since the last call have selected; empty:
  /// all.
  [[nodiscard]] std::vector<uint8_t> beyond(double bound,
                                            const std::vector<uint8_t>& changed = {}) {
    if (number_ == 0)
      return check_->beyond(bound, state_.signs, state_.scalars, state_.active, changed);
    const FurtherSurface<D>& last = state_.rare.further.surfaces().back();
    return check_->beyond(bound, last.signs, last.scalars, last.active, changed);
  }
  /// The largest distance of a vertex from the source's, of the isovalue in work, grid steps; as of
  /// the last call of beyond().
  [[nodiscard]] double largestError() const { return check_->largest(); }
  void select(std::vector<uint8_t> marked) { source_->quantized().select(std::move(marked)); }

  /// Codes planned displacements; `steps`: in those of the pass.
  void displace(const DisplacementPass& pass, Displacements<D> steps) {
    GeometryPass<D> geometryPass;
    geometryPass.kind = LayerKind::Displacement;
    geometryPass.displacement = pass;
    source_->quantized().displace(std::move(steps));
    geometry(geometryPass);
  }
  /// On the level coded last. To be called once on the finest level.
  [[nodiscard]] DisplacementPlan<D> displacementPlan() {
    if (state_.level == finestLevel_ && finestPlan_) return std::move(*finestPlan_);
    if (state_.active.empty()) state_.findActive();
    return DisplacementPlan<D>(source_->field(), state_.signs, state_.active, state_.filter,
                               options_.runTasks);
  }
  [[nodiscard]] const Displacements<D>& displacements() const { return state_.displacements; }

  [[nodiscard]] const CodedLayers& coded() const { return layers_; }

 private:
  /// prepare(exchange) gives the exchange what a layer needs beside signs and scalars.
  template <class Prepare>
  void code(LayerHead head, const Signs<D>& actual, const GeometryPass<D>& pass, Prepare prepare) {
    LayerSections sections(1);
    if (state_.header.chunks(traitsOf(head.kind).isFurther ? 0 : head.level) > 1)
      sections = chunkSections(head, actual, pass);
    else
      sections[0] =
          codedSection(head.kind, pass, actual, source_->quantized(), [&](auto& exchange) {
            prepare(exchange);
            state_.code(exchange, head, pass);
          });
    head.error = rms();
    layers_.add(std::move(head), std::move(sections));
  }
  void code(const LayerHead& head, const Signs<D>& actual, const GeometryPass<D>& pass = {}) {
    code(head, actual, pass, [](auto&) {});
  }

  /// Codes a refinement or a pass chunk by chunk.
  LayerSections chunkSections(LayerHead& head, const Signs<D>& actual,
                              const GeometryPass<D>& pass) {
    const auto count = static_cast<std::size_t>(state_.header.chunks(head.level));
    LayerSections sections(count);
    if (head.kind != LayerKind::Refinement) {
      runAll(options_.runTasks, count, [&](std::size_t n) {
        const std::size_t i = chunkOrder_[n];
        if (level_.chunks()[i]) sections[i] = passSection(*level_.chunks()[i], i, pass);
      });
      level_.finishPass(pass, true, state_);
      return sections;
    }
    chunkOrder_ = largestFirst(actual, state_.header.chunkSide);
    typename ChunkedLevel<D>::Chunks chunks(count);
    runAll(options_.runTasks, count, [&](std::size_t n) {
      const std::size_t i = chunkOrder_[n];
      if (isQuiet(i, actual)) return;
      chunks[i] = ChunkedLevel<D>::next(state_, i);
      sections[i] = signSection(*chunks[i], actual);
    });
    head.filter = static_cast<uint8_t>(filter_);
    auto joined = ChunkedLevel<D>::join(state_, std::vector<uint8_t>(count, 1), true, chunks);
    level_.finishLevel(std::move(joined), std::move(chunks), filter_, state_, options_.runTasks);
    return sections;
  }
  /// Has a chunk one sign only, as the level before around it?
  [[nodiscard]] bool isQuiet(std::size_t number, const Signs<D>& actual) const {
    const auto sign = ChunkedLevel<D>::uniform(state_, number);
    bool quiet = sign.has_value();
    forEachBrickOf(
        ChunkGrid<D>(actual.lattice(), state_.header.chunkSide).chunk(number), actual.table(),
        [&](std::size_t brickIndex) { quiet = quiet && actual.slot(brickIndex) == *sign; });
    return quiet;
  }
  /// Empty if the chunk has no surface: its signs are those of the level before.
  std::vector<std::byte> signSection(ChunkState<D>& chunk, const Signs<D>& actual) const {
    const Signs<D> own = cropped(actual, chunk.signs().lattice(), chunk.indices());
    if (!chunk.hasSigns() && !chunk.differs(own)) return {};
    RefinementCoder<D> coder = state_.refinement;
    return codedSection(LayerKind::Refinement, GeometryPass<D>{}, own, source_->quantized(),
                        [&](auto& exchange) { chunk.codeSigns(exchange, coder); });
  }
  std::vector<std::byte> passSection(ChunkState<D>& chunk, std::size_t number,
                                     const GeometryPass<D>& pass) const {
    const ChunkGrid<D> grid(state_.signs.lattice(), state_.header.chunkSide);
    const ChunkField<D> field(source_->field(), state_.header, source_->quantized(),
                              grid.chunk(number), chunk);
    return codedSection(pass.kind, pass, chunk.signs(), field, [&](auto& exchange) {
      chunk.codePass(exchange, pass, state_.filter, state_.header.fitted);
    });
  }

  /// May a pass code values other than the actual ones? Not if it repairs, if a later pass refines
  /// all its intervals, if signs of further isovalues depend on them, if diagonals have crossings
  /// too, or if the bound is so loose that most vertices keep the intervals of exponents.
  [[nodiscard]] bool usesRdoq(const GeometryPass<D>& pass) const {
    constexpr double kLoosest = 0.15;
    const Header& header = state_.header;
    if (pass.kind != LayerKind::Magnitudes || pass.selective || header.lossless ||
        header.polygonizer != Polygonizer::Cubes || !header.furtherIsovalues.empty())
      return false;
    if (header.maxError > kLoosest) return false;
    for (unsigned a = 0; a < D; ++a) {
      const uint32_t allowed = pass.allowed[1u << a];
      if (allowed == 0 ||
          allowed > 65536 * header.maxError / edgeLength(header.placement, 1u << a) + 1)
        return false;
    }
    return true;
  }

  /// The smoothing filter that locates the finest level's surface best.
  [[nodiscard]] SmoothingFilter finestFilter() const {
    constexpr std::array kFilters{SmoothingFilter::Narrow, SmoothingFilter::Middle,
                                  SmoothingFilter::Wide};
    std::array<double, kFilters.size()> errors;
    runAll(options_.runTasks, kFilters.size(), [&](std::size_t i) {
      errors[i] = source_->distance().rms(source_->signs(), {}, {kFilters[i]});
    });
    return kFilters[static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) -
                                             errors.begin())];
  }
  /// That of another level: coarser levels are less smooth.
  [[nodiscard]] SmoothingFilter filterOf(int level, SmoothingFilter finest) const {
    if (level == finestLevel_) return finest;
    return level == finestLevel_ - 1 && finest == SmoothingFilter::Wide ? SmoothingFilter::Middle
                                                                        : SmoothingFilter::Narrow;
  }

  [[nodiscard]] double rms() const {
    const SourceDistance<D>& distance = source_->distance();
    if (state_.rare.partial)
      return distance.rms(state_.rare.partial->shown(finestLevel_)->signs, Hints<D>{});
    if (state_.level < finestLevel_) return distance.rms(state_.signs, state_.hints());
    if (number_ == 0 && !state_.magnitudesRefined && state_.scalars.tableSize() != 0) {
      Scalars<D> shown = state_.scalars.only(distance.bricks());
      const int finer = state_.scalars.room();
      shown.scale(finer);
      Dequantization<D>::apply(state_.signs.table(), state_.scalars, finer, shown,
                               distance.bricks());
      return distance.rms(state_.signs, shown, state_.hints(), finer);
    }
    if (number_ == 0) return distance.rms(state_.signs, state_.scalars, state_.hints());
    const FurtherSurface<D>& last = state_.rare.further.surfaces().back();
    if (last.coded[0]) return distance.rms(last.signs, last.scalars);
    Scalars<D> estimated = last.scalars;
    estimateMissing(last.signs, last.active, Members::AxisEnds, 0, estimated, {state_.filter});
    return distance.rms(last.signs, estimated);
  }

  const EncodeOptions& options_;
  const int finestLevel_;
  int number_ = 0;  // of the current isovalue
  Source<D>* source_;
  std::optional<BoundCheck<D>> check_;  // of the current isovalue
  CodecState<D> state_;
  ChunkedLevel<D> level_;
  std::vector<std::size_t> chunkOrder_;  // in which tasks code the chunks of a level
  std::optional<DisplacementPlan<D>> finestPlan_;
  SmoothingFilter filter_ = SmoothingFilter::Middle;  // of the level in work
  CodedLayers layers_;
};

}  // namespace isostar
