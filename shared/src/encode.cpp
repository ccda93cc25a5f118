#include <algorithm>
#include <cmath>

#include "encode_adaptive.h"
#include "field.h"
#include "isostar/isostar.h"
#include "layers.h"
#include "source_distance.h"

namespace isostar {
namespace {

/// Tells layers one after the other.
template <int D>
class LayerWriter {
 public:
  LayerWriter(const Header& header, const EncodeOptions& options, const QuantizedField<D>& field, const SourceDistance<D>& distance)
      : options_(options), octaves_(header.octaves()), field_(field), distance_(distance), known_(header) {}

  void signs(const Signs<D>& finest) {
    std::vector<Signs<D>> coarse(static_cast<std::size_t>(octaves_));
    for (std::size_t level = coarse.size(); level-- > 0;) coarse[level] = coarsened(level + 1 < coarse.size() ? coarse[level + 1] : finest);
    for (int level = 0; level <= octaves_; ++level) {
      const Signs<D>& truth = level < octaves_ ? coarse[static_cast<std::size_t>(level)] : finest;
      tell({level == 0 ? LayerKind::Base : LayerKind::Refinement, level, 0, 0, 0}, truth, [&](auto& ask) {
        if (level == 0) known_.base(ask);
        else known_.refine(ask);
      });
      if (options_.progress) options_.progress(0.5 * (level + 1) / (octaves_ + 1));
    }
  }

  void geometry(const GeometryPass<D>& pass) {
    tell({pass.kind, octaves_, 0, 0, 0}, known_.signs, [&](auto& ask) { known_.geometry(ask, pass); }, &pass);
  }

  /// The bricks where a vertex of the surface is off by more than the bound, by place; none if there are none.
  [[nodiscard]] std::vector<uint8_t> beyond(double bound) const { return distance_.beyond(bound, known_.signs, known_.scalars, known_.active); }
  void select(std::vector<uint8_t> places) { field_.select(std::move(places)); }

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
    TruthExchange<D, RangeEncoder, QuantizedField<D>> ask(coder, truth, field_);
    what(ask);
    coder.finish();
    head.error = head.level < octaves_ ? distance_.rms(known_.signs) : distance_.rms(known_.signs, known_.scalars);
    head.bytes = layer.size();
    head.checksum = checksum(head, layer);
    ByteWriter out(bytes_);
    write(out, head);
    bytes_.insert(bytes_.end(), layer.begin(), layer.end());
  }

  const EncodeOptions& options_;
  const int octaves_;
  QuantizedField<D> field_;
  const SourceDistance<D>& distance_;
  Knowledge<D> known_;
  std::vector<std::byte> bytes_;
};

/// How far a crossing may move along an edge for a distance in grid steps along the smallest spacing; edges along
/// several axes only count for tetrahedra.
template <int D>
typename HalvingCoder<D>::Allowed allowed(const Header& header, double distance) {
  typename HalvingCoder<D>::Allowed result{};
  for (unsigned axes = 1; axes < result.size(); ++axes) {
    if (header.polygonizer == Polygonizer::Cubes && !std::has_single_bit(axes)) continue;
    result[axes] = static_cast<uint32_t>(std::clamp(65536 * distance / edgeLength(header.placement, axes), 0.0, 65536.0));
  }
  // The last also says whether diagonals count: even where nothing may move they do.
  if (header.polygonizer == Polygonizer::Tetrahedra) result.back() = std::max(result.back(), 1u);
  return result;
}

/// One pass, for all scalars that the stream's polygonizer needs.
template <int D>
void tellPass(LayerWriter<D>& layers, const Header& header, GeometryPass<D> pass) {
  layers.geometry(pass);
  if (header.polygonizer == Polygonizer::Cubes) return;
  pass.members = Members::DiagonalEnds;
  layers.geometry(pass);
}

template <int D>
GeometryPass<D> halving(const Header& header, double distance) {
  return {LayerKind::Halving, Members::AxisEnds, 0, allowed<D>(header, distance), 30, false};
}

/// Octaves, then halvings to half the distance each, until the bound holds.
template <int D>
void tellGeometry(LayerWriter<D>& layers, const Header& header) {
  constexpr double kCoarsest = 0.1;  // octaves alone are nearly as good
  constexpr double kFinestOfLossless = 0.025;
  constexpr double kFinest = 1e-6;  // all is told
  const double bound = header.lossless ? 0 : std::max(double{header.maxError}, kFinest);
  tellPass<D>(layers, header, {LayerKind::Octaves, Members::AxisEnds, bound > 0.3 ? 1 : bound > 0.15 ? 2 : 3, {}, 0, false});
  double distance = header.lossless ? kFinestOfLossless : bound;
  while (distance * 2 < kCoarsest) distance *= 2;
  for (; distance > (header.lossless ? kFinestOfLossless * 0.9 : bound * 1.1); distance /= header.lossless ? 4 : 2) {
    tellPass(layers, header, halving<D>(header, distance));
  }
  tellPass(layers, header, halving<D>(header, bound));
  if (header.lossless) return;
  // What moves a crossing is judged to first order. Where that was not enough, the bricks concerned go further.
  for (distance = bound / 2; distance > bound / 64; distance /= 2) {
    auto places = layers.beyond(bound);
    if (places.empty()) return;
    layers.select(std::move(places));
    GeometryPass<D> repair = halving<D>(header, distance);
    repair.selective = true;
    tellPass(layers, header, repair);
  }
}

Error put(Header& header, const std::vector<std::byte>& layers, const EncodeOptions& options, std::vector<std::byte>& out) {
  header.bytes = layers.size();
  ByteWriter writer(out);
  write(writer, header);
  out.insert(out.end(), layers.begin(), layers.end());
  if (options.progress) options.progress(1);
  return Error::None;
}

/// Does all that does not depend on whose samples they are; the header already tells size and placement.
template <int D>
Error encodeGrid(std::span<const float> samples, Header header, const EncodeOptions& options, std::vector<std::byte>& out) {
  Coordinates<D> size;
  std::copy_n(header.size.begin(), D, size.begin());
  const bool bounded = options.lossless || (options.maxError > 0 && std::isfinite(options.maxError));
  if (options.adaptive && (options.lossless || D == 4)) return Error::BadArgument;
  if (!bounded || !invertible(header.placement) || !sensible<D>(samples, size, options.isovalue)) return Error::BadArgument;
  header.isovalue = options.isovalue;
  header.polygonizer = options.polygonizer;
  header.lossless = options.lossless;
  header.maxError = options.lossless ? 0 : std::clamp(options.maxError, 1e-9, 1e9);
  const GridField<D> field(samples, size, options.isovalue);
  const auto finest = field.signs();
  const auto active = activeBricks(finest);
  field.quantize(header, finest, active);
  header.vertices = countCrossings(finest, active);
  Header adaptiveHeader = header;
  std::vector<std::byte> adaptive;
  if constexpr (D < 4) {
    if (options.adaptive && header.vertices != 0) {
      adaptiveHeader.adaptive = true;
      if (!encodeAdaptive(field, options, finest, adaptiveHeader, adaptive)) adaptive.clear();
    }
  }
  const SourceDistance<D> distance(field, header, finest, active);
  LayerWriter<D> layers(header, options, QuantizedField<D>(field, header, finest), distance);
  layers.signs(finest);
  if (header.vertices != 0) tellGeometry(layers, header);
  // Where coarse simplices do not pay, there are none.
  if (!adaptive.empty() && adaptive.size() < layers.bytes().size()) return put(adaptiveHeader, adaptive, options, out);
  return put(header, layers.bytes(), options, out);
}

}  // namespace

Error encode(const Image& image, const EncodeOptions& options, std::vector<std::byte>& out) {
  return encodeGrid<2>(image.samples, headerOf(image), options, out);
}
Error encode(const Volume& volume, const EncodeOptions& options, std::vector<std::byte>& out) {
  return encodeGrid<3>(volume.samples, headerOf(volume), options, out);
}
Error encode(const Sequence& sequence, const EncodeOptions& options, std::vector<std::byte>& out) {
  return encodeGrid<4>(sequence.samples, headerOf(sequence), options, out);
}

}  // namespace isostar
