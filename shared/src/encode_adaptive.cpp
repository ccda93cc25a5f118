#include "encode_adaptive.h"

#include <algorithm>
#include <cmath>

#include "adaptive_distance.h"
#include "layers.h"
#include "source_distance.h"

namespace isostar {
namespace {

/// The scalars that a plan has chosen, as the quanta of one octave.
template <int D>
class PlannedField {
 public:
  PlannedField(const AdaptivePlan<D>& plan, const Header& header) : plan_(plan), header_(header) {}
  void enter(int level, const Signs<D>& signs) {
    level_ = level;
    signs_ = &signs;
  }
  [[nodiscard]] uint32_t magnitude(std::size_t place, std::size_t r, int x) const { return quanta(vertex(place, r, x)); }
  /// The mean difference along crossing axis edges, 4 log2 of quanta.
  [[nodiscard]] int gradient(std::size_t place) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < Scalars<D>::kVertices; ++i) {
      const auto v = vertex(place, i / kBrickSide, static_cast<int>(i % kBrickSide));
      bool inside = true;
      for (int a = 0; a < D; ++a) inside = inside && v[a] <= signs_->lattice().last[a];
      for (int a = 0; inside && a < D; ++a) {
        auto next = v;
        if (++next[a] > signs_->lattice().last[a] || signs_->at(next) == signs_->at(v)) continue;
        sum += static_cast<double>(quanta(v)) + quanta(next) + 1;
        ++count;
      }
    }
    return count == 0 ? 0 : std::clamp(static_cast<int>(std::lround(4 * std::log2(sum / count))), 0, 4 * 31);
  }
  [[nodiscard]] bool selected(std::size_t) const { return true; }

 private:
  [[nodiscard]] Coordinates<D> vertex(std::size_t place, std::size_t r, int x) const {
    auto v = signs_->table().brick(place);
    for (int a = 0; a < D; ++a) {
      v[a] = v[a] * kBrickSide + (a == 0 ? x : static_cast<int32_t>(r % kBrickSide));
      if (a != 0) r /= kBrickSide;
    }
    return v;
  }
  [[nodiscard]] uint32_t quanta(const Coordinates<D>& v) const {
    return static_cast<uint32_t>(std::min(std::abs(plan_.scalar(level_, v)) / header_.quantum, double((1 << 29) - 1)));
  }

  const AdaptivePlan<D>& plan_;
  const Header& header_;
  int level_ = 0;
  const Signs<D>* signs_ = nullptr;
};

/// One try at a stream: the plan's mesh, told.
template <int D>
class AdaptiveWriter {
 public:
  AdaptiveWriter(const AdaptivePlan<D>& plan, const GridField<D>& field, const Header& header, const SourceDistance<D>& distance, const std::vector<Signs<D>>& truth, bool states)
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
      tell({LayerKind::Halving, level, 0, 0, 0}, truth, [&](auto& ask) { decoded_.tellHalvings(ask, {pass.members, pass.allowed, pass.most, pass.selective}); }, &pass);
    }
  }

  [[nodiscard]] const AdaptiveField<D>& decoded() const { return decoded_; }
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  template <class Tell>
  void tell(LayerHead head, const Signs<D>& truth, Tell what, const GeometryPass<D>* pass = nullptr) {
    std::vector<std::byte> layer;
    if (pass != nullptr) {
      ByteWriter fields(layer);
      pass->write(fields);
    }
    RangeEncoder coder(layer);
    TruthExchange<D, RangeEncoder, PlannedField<D>> ask(coder, truth, planned_);
    what(ask);
    coder.finish();
    head.error = states_ ? error() : 0;
    append(bytes_, head, layer);
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
  std::vector<std::byte> bytes_;
};

/// Quanta fine enough for any bound, and room for the scalars of the coarsest vertices.
template <int D>
void quantize(const AdaptivePlan<D>& plan, Header& header) {
  double steepest = 0;
  for (const auto& c : plan.crossings()) steepest = std::max(steepest, c.gradient);
  constexpr double kFarthest = 128;  // grid steps
  header.whole = false;
  header.quantum = std::ldexp(1.0, std::ilogb(steepest * kFarthest) + 1 - 28);
  header.positiveOffset = header.negativeOffset = 0.5;
}

}  // namespace

template <int D>
bool encodeAdaptive(const GridField<D>& field, const EncodeOptions& options, const Signs<D>& finest, Header& header, std::vector<std::byte>& layers) {
  constexpr int kTries = 14;
  constexpr double kFirstOrder = 1.15;  // distances are judged to first order: exact ones were up to 1.13 times as large
  constexpr uint64_t kHopeless = uint64_t{1} << 32;
  constexpr double kFlat = 0.9, kQuantized = 1.0;  // of the bound: what is allowed is the worst, and both seldom meet
  AdaptivePlan<D> plan(field, header, finest);
  quantize(plan, header);
  const SourceDistance<D> distance(field, header, finest, activeBricks(finest));
  std::vector<Signs<D>> truth(static_cast<std::size_t>(plan.octaves()) + 1);
  truth.back() = finest;
  for (std::size_t level = truth.size() - 1; level-- > 0;) truth[level] = coarsened(truth[level + 1]);
  double quantized = kQuantized * header.maxError;
  for (int i = 0;; ++i) {
    plan.keep(kFlat * header.maxError);
    AdaptiveWriter<D> writer(plan, field, header, distance, truth, false);
    writer.signs();
    writer.geometry(quantized);
    const auto& decoded = writer.decoded().octave(plan.octaves());
    if (options.progress) options.progress((i + 1.0) / (kTries + 1));
    uint64_t beyond = 0;
    const auto judge = [&](const auto& p, double d) {
      if (d * kFirstOrder > header.maxError) beyond += plan.forbid(p, std::min(0.5 + 0.5 * i, 1.5)) ? 1 : kHopeless;
    };
    const AdaptiveDistance<D> measured(plan, field, decoded);
    measured.fromSource(1, judge);
    measured.fromDecoded(judge);
    if (beyond == 0) break;
    if (i == kTries) return false;
    // Where nothing is left to split, or splitting helps no more, scalars must be finer.
    if (beyond >= kHopeless || i >= kTries / 2) quantized *= 0.85;
  }
  AdaptiveWriter<D> writer(plan, field, header, distance, truth, true);
  writer.signs();
  writer.geometry(quantized);
  layers = writer.bytes();
  const auto& decoded = writer.decoded().octave(plan.octaves());
  header.vertices = countCrossings(decoded.signs, decoded.active);
  return true;
}

template bool encodeAdaptive<2>(const GridField<2>&, const EncodeOptions&, const Signs<2>&, Header&, std::vector<std::byte>&);
template bool encodeAdaptive<3>(const GridField<3>&, const EncodeOptions&, const Signs<3>&, Header&, std::vector<std::byte>&);

}  // namespace isostar
