// Tells layers: the encoder's half of the traversal.
#pragma once

#include <limits>

#include "coding/codec_state.h"
#include "encoder/core/displacement_plan.h"
#include "encoder/core/layer_bytes.h"
#include "encoder/core/source.h"
#include "encoder/topology/encode_topology.h"
#include "isostar/isostar.h"

namespace isostar {

/// Tells layers one after the other.
template <int D>
class UniformWriter {
 public:
  UniformWriter(const Header& header, const EncodeOptions& options, Source<D>& first)
      : options_(options), finestLevel_(header.finestLevel()), source_(&first), known_(header) {}

  /// The signs of all octaves; after(level) may tell more of each but those of streams of one
  /// topology.
  template <class After>
  void signs(After after) {
    const Signs<D>& finest = source_->signs();
    std::vector<Signs<D>> coarse(static_cast<std::size_t>(finestLevel_));
    for (std::size_t level = coarse.size(); level-- > 0;)
      coarse[level] = coarsened(level + 1 < coarse.size() ? coarse[level + 1] : finest);
    std::vector<Signs<D>> whole;
    if constexpr (D == 3) {
      if (known_.header.keepsTopology) {
        coarse.push_back(finest);
        whole = wholeCells(known_.header, coarse);
      }
    }
    const SmoothingFilter filter = finestFilter();
    for (int level = 0; level <= finestLevel_; ++level) {
      const Signs<D>& actual =
          level < finestLevel_ ? coarse[static_cast<std::size_t>(level)] : finest;
      const LayerHead head{.kind = level == 0 ? LayerKind::Base : LayerKind::Refinement,
                           .level = level};
      code(head, actual, {}, [&](auto& exchange) {
        exchange.follow(coarse, whole);
        exchange.see(filterOf(level, filter));
      });
      if (!known_.partial) after(level);
      if (options_.progress) options_.progress(0.5 * (level + 1) / (finestLevel_ + 1));
    }
  }

  void domain() { code({.kind = LayerKind::Domain, .level = finestLevel_}, source_->signs()); }

  /// The signs of a further isovalue; passes are its from now on.
  void furtherSigns(int number, Source<D>& source) {
    number_ = number;
    source_ = &source;
    code({.kind = LayerKind::FurtherSigns, .level = number}, source.signs());
  }

  void geometry(const GeometryPass<D>& pass) {
    source_->quantized().setRdoq(number_ == 0 && settles(pass));
    code({.kind = number_ == 0 ? pass.kind : LayerKind::FurtherGeometry,
          .level = number_ == 0 ? known_.level : number_},
         source_->signs(), pass);
  }

  /// The bricks where a vertex of the surface is off by more than the bound, by place; none if
  /// there are none.
  [[nodiscard]] std::vector<uint8_t> beyond(double bound) const {
    if (number_ == 0)
      return source_->distance().beyond(bound, known_.signs, known_.scalars, known_.active);
    const FurtherSurface<D>& last = known_.further.surfaces().back();
    return source_->distance().beyond(bound, last.signs, last.scalars, last.active);
  }
  void select(std::vector<uint8_t> brickIndices) {
    source_->quantized().select(std::move(brickIndices));
  }

  /// Displacements as planned; `steps`: of a pass.
  void displace(const DisplacementPass& pass, Displacements<D> steps) {
    GeometryPass<D> geometryPass;
    geometryPass.kind = LayerKind::Displacement;
    geometryPass.displacement = pass;
    source_->quantized().displace(std::move(steps));
    geometry(geometryPass);
  }
  /// Of the octave told last.
  [[nodiscard]] DisplacementPlan<D> displacementPlan() {
    if (known_.active.empty()) known_.findActive();
    return DisplacementPlan<D>(source_->field(), known_.signs, known_.active, known_.filter);
  }
  [[nodiscard]] const Displacements<D>& displacements() const { return known_.displacements; }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return layers_.bytes(); }

 private:
  /// prepare(exchange): what a layer needs beside signs and scalars.
  template <class Prepare>
  void code(const LayerHead& head, const Signs<D>& actual, const GeometryPass<D>& pass,
            Prepare prepare) {
    layers_.add(
        head, pass, actual, source_->quantized(),
        [&](auto& exchange) {
          prepare(exchange);
          known_.code(exchange, head, pass);
        },
        [&] { return rms(); });
  }
  void code(const LayerHead& head, const Signs<D>& actual, const GeometryPass<D>& pass = {}) {
    code(head, actual, pass, [](auto&) {});
  }

  /// May a pass tell what is nearly true? Not where it repairs or a later one narrows all its
  /// intervals or a further isovalue's signs are known by them, nor where diagonals have crossings,
  /// too, or bounds are so loose that most vertices keep what octaves say.
  [[nodiscard]] bool settles(const GeometryPass<D>& pass) const {
    constexpr double kLoosest = 0.15;
    const Header& header = known_.header;
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

  /// The kernel that places the finest octave's surface best.
  [[nodiscard]] SmoothingFilter finestFilter() const {
    SmoothingFilter best = SmoothingFilter::Narrow;
    double least = std::numeric_limits<double>::infinity();
    for (const SmoothingFilter filter :
         {SmoothingFilter::Narrow, SmoothingFilter::Middle, SmoothingFilter::Wide}) {
      const double error = source_->distance().rms(source_->signs(), {}, {filter});
      if (error < least) best = filter, least = error;
    }
    return best;
  }
  /// That of another octave: coarser ones are less smooth.
  [[nodiscard]] SmoothingFilter filterOf(int level, SmoothingFilter finest) const {
    if (level == finestLevel_) return finest;
    return level == finestLevel_ - 1 && finest == SmoothingFilter::Wide ? SmoothingFilter::Middle
                                                                        : SmoothingFilter::Narrow;
  }

  [[nodiscard]] double rms() const {
    const SourceDistance<D>& distance = source_->distance();
    if (known_.partial)
      return distance.rms(known_.partial->shown(finestLevel_)->signs, {known_.partial->filter});
    if (known_.level < finestLevel_) return distance.rms(known_.signs, known_.hints());
    if (number_ == 0 && !known_.magnitudesRefined && known_.scalars.tableSize() != 0) {
      Scalars<D> shown = known_.scalars;
      const int finer = shown.magnify();
      Dequantization<D>::apply(known_.signs.table(), known_.scalars, finer, shown,
                               distance.tableSize());
      return distance.rms(known_.signs, shown, known_.hints(), finer);
    }
    if (number_ == 0) return distance.rms(known_.signs, known_.scalars, known_.hints());
    const FurtherSurface<D>& last = known_.further.surfaces().back();
    if (last.coded[0]) return distance.rms(last.signs, last.scalars);
    Scalars<D> estimated = last.scalars;
    estimateMissing(last.signs, last.active, Members::AxisEnds, 0, estimated, {known_.filter});
    return distance.rms(last.signs, estimated);
  }

  const EncodeOptions& options_;
  const int finestLevel_;
  int number_ = 0;  // of the isovalue in work
  Source<D>* source_;
  CodecState<D> known_;
  LayerBytes layers_;
};

}  // namespace isostar
