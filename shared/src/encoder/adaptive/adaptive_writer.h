// Writes the layers of an adaptive stream.
#pragma once

#include "coding/adaptive/adaptive_field.h"
#include "encoder/adaptive/adaptive_distance.h"
#include "encoder/adaptive/planned_field.h"
#include "encoder/core/coded_layers.h"
#include "encoder/core/source_distance.h"

namespace isostar {

/// One attempt at a stream: codes the plan's mesh.
template <int D>
class AdaptiveWriter {
 public:
  AdaptiveWriter(const AdaptivePlan<D>& plan, const GridField<D>& field, const Header& header,
                 const SourceDistance<D>& distance, const std::vector<Signs<D>>& actual,
                 bool writesErrors)
      : plan_(plan),
        field_(field),
        header_(header),
        distance_(distance),
        actual_(actual),
        writesErrors_(writesErrors),
        planned_(plan, header),
        decoded_(header.base<D>()) {}

  void signs() {
    for (int level = 0; level <= plan_.finestLevel(); ++level) {
      const Signs<D>& actual = actual_[static_cast<std::size_t>(level)];
      const Signs<D> centres = level == 0 ? Signs<D>() : plan_.centres(level);
      code({.kind = level == 0 ? LayerKind::Base : LayerKind::Refinement}, level, actual,
           [&](auto& exchange) { exchange.setKept(centres); });
    }
  }

  /// Codes the scalars of all levels, so that quantization moves the surface by at most `distance`
  /// grid steps.
  void geometry(double distance) {
    for (int level = 0; level <= plan_.finestLevel(); ++level) {
      const Signs<D>& actual = actual_[static_cast<std::size_t>(level)];
      planned_.enter(level, actual);
      code({.kind = LayerKind::Exponents}, level, actual);
      GeometryPass<D> pass{.kind = LayerKind::Magnitudes, .most = 30};
      for (unsigned axes = 1; axes < pass.allowed.size(); ++axes) {
        const double part = distance / (edgeLength(header_.placement, axes) *
                                        decoded_.at(level).signs.lattice().step);
        pass.allowed[axes] = static_cast<uint32_t>(std::clamp(65536 * part, 1.0, 65536.0));
      }
      code(pass, level, actual);
    }
  }

  [[nodiscard]] const AdaptiveField<D>& decoded() const { return decoded_; }
  [[nodiscard]] CodedLayers& layers() { return layers_; }

 private:
  /// prepare(exchange) gives the exchange what a layer needs beside signs and scalars.
  template <class Prepare>
  void code(const GeometryPass<D>& pass, int level, const Signs<D>& actual, Prepare prepare) {
    auto section = codedSection(pass.kind, pass, actual, planned_, [&](auto& exchange) {
      prepare(exchange);
      decoded_.code(exchange, pass, header_);
    });
    layers_.add({.kind = pass.kind, .level = level, .error = writesErrors_ ? error() : 0},
                {std::move(section)});
  }
  void code(const GeometryPass<D>& pass, int level, const Signs<D>& actual) {
    code(pass, level, actual, [](auto&) {});
  }

  /// RMS distance of the surface that a decoder shows now, in grid steps.
  [[nodiscard]] double error() const {
    if (decoded_.mesh.level() < plan_.finestLevel())
      return distance_.rms(decoded_.shown(decoded_.mesh.level())->signs, Hints<D>{});
    constexpr std::size_t kSamples = 4096;
    const auto shown = *decoded_.shown(decoded_.mesh.level());
    double sum = 0;
    uint64_t count = 0;
    AdaptiveDistance<D>(plan_, field_, shown)
        .fromSource(plan_.crossings().size() / kSamples + 1, [&](const auto&, double d) {
          sum += d * d;
          ++count;
        });
    return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
  }

  const AdaptivePlan<D>& plan_;
  const GridField<D>& field_;
  const Header& header_;
  const SourceDistance<D>& distance_;
  const std::vector<Signs<D>>& actual_;  // by level
  const bool writesErrors_;              // into the layers' heads; attempts do not need it
  PlannedField<D> planned_;
  AdaptiveField<D> decoded_;
  CodedLayers layers_;
};

}  // namespace isostar
