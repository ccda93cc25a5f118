// Tells the layers of an adaptive stream.
#pragma once

#include "encoder/adaptive/adaptive_distance.h"
#include "coding/adaptive/adaptive_field.h"
#include "encoder/core/layer_bytes.h"
#include "encoder/adaptive/planned_field.h"
#include "encoder/core/source_distance.h"

namespace isostar {

/// One try at a stream: the plan's mesh, told.
template <int D>
class AdaptiveWriter {
 public:
  AdaptiveWriter(const AdaptivePlan<D>& plan, const GridField<D>& field, const Header& header, const SourceDistance<D>& distance,
                 const std::vector<Signs<D>>& truth, bool states)
      : plan_(plan), field_(field), header_(header), distance_(distance), truth_(truth), states_(states), planned_(plan, header), decoded_(header.base<D>()) {}

  void signs() {
    for (int level = 0; level <= plan_.octaves(); ++level) {
      const Signs<D>& truth = truth_[static_cast<std::size_t>(level)];
      const Signs<D> centres = level == 0 ? Signs<D>() : plan_.centres(level);
      tell({level == 0 ? LayerKind::Base : LayerKind::Refinement, level, 0, 0, 0}, truth, [&](auto& ask) {
        ask.keep(centres);
        if (level == 0) decoded_.mesh.base(ask);
        else decoded_.mesh.refine(ask);
      });
    }
  }

  /// Scalars of all octaves, such that quantization moves the surface by no more than a distance.
  void geometry(double distance) {
    for (int level = 0; level <= plan_.octaves(); ++level) {
      GeometryPass<D> pass{LayerKind::Octaves, Members::AxisEnds, 3, {}, 0, false};
      const Signs<D>& truth = truth_[static_cast<std::size_t>(level)];
      planned_.enter(level, truth);
      tell({LayerKind::Octaves, level, 0, 0, 0}, truth, [&](auto& ask) { decoded_.tellOctaves(ask, pass.depth, header_.polygonizer); }, &pass);
      pass = {LayerKind::Halving, Members::AxisEnds, 0, {}, 30, false};
      for (unsigned axes = 1; axes < pass.allowed.size(); ++axes) {
        const double part = distance / (edgeLength(header_.placement, axes) * decoded_.octave(level).signs.lattice().step);
        pass.allowed[axes] = static_cast<uint32_t>(std::clamp(65536 * part, 1.0, 65536.0));
      }
      tell({LayerKind::Halving, level, 0, 0, 0}, truth, [&](auto& ask) { decoded_.tellHalvings(ask, pass.halving(header_.fitted)); }, &pass);
    }
  }

  [[nodiscard]] const AdaptiveField<D>& decoded() const { return decoded_; }
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return layers_.bytes(); }

 private:
  template <class Tell>
  void tell(LayerHead head, const Signs<D>& truth, Tell what, const GeometryPass<D>* pass = nullptr) {
    layers_.add(head, pass, truth, planned_, what, [&] { return states_ ? error() : 0; });
  }

  /// RMS distance of what a decoder shows now.
  [[nodiscard]] double error() const {
    if (decoded_.mesh.level() < plan_.octaves()) return distance_.rms(decoded_.shown(decoded_.mesh.level())->signs, {decoded_.kernel});
    constexpr std::size_t kSamples = 4096;
    const auto shown = *decoded_.shown(decoded_.mesh.level());
    double sum = 0;
    uint64_t count = 0;
    AdaptiveDistance<D>(plan_, field_, shown).fromSource(plan_.crossings().size() / kSamples + 1, [&](const auto&, double d) {
      sum += d * d;
      ++count;
    });
    return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
  }

  const AdaptivePlan<D>& plan_;
  const GridField<D>& field_;
  const Header& header_;
  const SourceDistance<D>& distance_;
  const std::vector<Signs<D>>& truth_;  // by octave
  const bool states_;                   // errors in heads; a try has no need of them
  PlannedField<D> planned_;
  AdaptiveField<D> decoded_;
  LayerBytes layers_;
};

}  // namespace isostar
