// Plans, codes and measures adaptive streams until one keeps the bound.
#include "encoder/adaptive/encode_adaptive.h"

#include <algorithm>
#include <cmath>

#include "encoder/adaptive/adaptive_writer.h"

namespace isostar {
namespace {

/// Chooses a quantization step that is fine enough for any bound and leaves room for the scalars of
/// the coarsest vertices.
template <int D>
void quantize(const AdaptivePlan<D>& plan, Header& header) {
  double steepest = 0;
  for (const auto& c : plan.crossings()) steepest = std::max(steepest, c.gradient);
  constexpr double kFarthest = 128;  // grid steps
  header.whole = false;
  header.quantizationStep = std::ldexp(1.0, std::ilogb(steepest * kFarthest) + 1 - 28);
  header.positiveOffset = header.negativeOffset = 0.5;
}

/// The source's signs on all levels.
template <int D>
std::vector<Signs<D>> signsByLevel(const Signs<D>& finest, int finestLevel) {
  std::vector<Signs<D>> signs(static_cast<std::size_t>(finestLevel) + 1);
  signs.back() = finest;
  for (std::size_t level = signs.size() - 1; level-- > 0;)
    signs[level] = coarsened(signs[level + 1]);
  return signs;
}

}  // namespace

template <int D>
bool encodeAdaptive(const GridField<D>& field, const EncodeOptions& options, const Signs<D>& finest,
                    Header& header, CodedLayers& layers) {
  constexpr int kTries = 14;
  // Distances are estimated to first order: exact ones were up to 1.13 times as large.
  constexpr double kFirstOrder = 1.15;
  constexpr uint64_t kNothingToSplit = uint64_t{1} << 32;
  // Parts of the bound, for flatness and for quantization: each is a worst case, and both rarely
  // coincide.
  constexpr double kFlat = 0.9, kQuantized = 1.0;
  AdaptivePlan<D> plan(field, header, finest);
  quantize(plan, header);
  const SourceDistance<D> distance(field, header, finest, activeBricks(finest));
  const std::vector<Signs<D>> actual = signsByLevel(finest, plan.finestLevel());
  double quantized = kQuantized * header.maxError;
  for (int i = 0;; ++i) {
    plan.findKeptCells(kFlat * header.maxError);
    AdaptiveWriter<D> writer(plan, field, header, distance, actual, false);
    writer.signs();
    writer.geometry(quantized);
    const auto& decoded = writer.decoded().at(plan.finestLevel());
    if (options.progress) options.progress((i + 1.0) / (kTries + 1));
    uint64_t beyond = 0;
    const auto judge = [&](const auto& p, double d) {
      if (d * kFirstOrder > header.maxError)
        beyond += plan.forbid(p, std::min(0.5 + 0.5 * i, 1.5)) ? 1 : kNothingToSplit;
    };
    const AdaptiveDistance<D> measured(plan, field, decoded);
    measured.fromSource(1, judge);
    measured.fromDecoded(judge);
    if (beyond == 0) break;
    if (i == kTries) return false;
    // If no cell is left to split, or splitting does not help any more, scalars must be finer.
    if (beyond >= kNothingToSplit || i >= kTries / 2) quantized *= 0.85;
  }
  AdaptiveWriter<D> writer(plan, field, header, distance, actual, true);
  writer.signs();
  writer.geometry(quantized);
  layers = std::move(writer.layers());
  const auto& decoded = writer.decoded().at(plan.finestLevel());
  header.vertices = countCrossings(decoded.signs, decoded.active);
  return true;
}

template bool encodeAdaptive<2>(const GridField<2>&, const EncodeOptions&, const Signs<2>&, Header&,
                                CodedLayers&);
template bool encodeAdaptive<3>(const GridField<3>&, const EncodeOptions&, const Signs<3>&, Header&,
                                CodedLayers&);

}  // namespace isostar
