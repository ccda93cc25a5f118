#include <algorithm>
#include <cmath>

#include "field.h"
#include "isostar/isostar.h"
#include "layers.h"
#include "source_distance.h"

namespace isostar {
namespace {

Header makeHeader(const Volume& volume, const EncodeOptions& options) {
  Header h;
  h.size = volume.size;
  h.placement = volume.placement;
  h.isovalue = options.isovalue;
  h.polygonizer = options.polygonizer;
  h.lossless = options.lossless;
  h.maxError = options.lossless ? 0 : static_cast<float>(std::clamp(options.maxError, 1e-9, 1e9));
  while (std::ranges::any_of(h.base().last, [](int32_t last) { return last > Header::kMostBaseCells; })) ++h.octaves;
  return h;
}

/// Tells layers one after the other.
class LayerWriter {
 public:
  LayerWriter(const GridField<3>& field, const Header& header, const EncodeOptions& options)
      : field_(field), header_(header), options_(options), quantized_(field, header), distance_(field, header), known_(header) {}

  void signs(const Signs<3>& finest) {
    for (int level = 0; level <= header_.octaves; ++level) {
      const Signs<3> coarse = level < header_.octaves ? field_.signs(int32_t{1} << (header_.octaves - level)) : Signs<3>();
      const Signs<3>& truth = level < header_.octaves ? coarse : finest;
      tell({level == 0 ? LayerKind::Base : LayerKind::Refinement, level, 0, 0, 0}, truth, [&](auto& ask) {
        if (level == 0) known_.base(ask);
        else known_.refine(ask);
      });
      if (options_.progress) options_.progress(0.5 * (level + 1) / (header_.octaves + 1));
    }
  }

  void geometry(const GeometryPass& pass) {
    tell({pass.kind, header_.octaves, 0, 0, 0}, known_.signs, [&](auto& ask) { known_.geometry(ask, pass); }, &pass);
  }

  /// The bricks where a vertex of the surface is off by more than the bound, by place; none if there are none.
  [[nodiscard]] std::vector<uint8_t> beyond(double bound) const { return distance_.beyond(bound, known_.signs, known_.scalars, known_.active); }
  void select(std::vector<uint8_t> places) { quantized_.select(std::move(places)); }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
  [[nodiscard]] uint32_t layers() const { return layers_; }

 private:
  template <class Tell>
  void tell(LayerHead head, const Signs<3>& truth, Tell what, const GeometryPass* pass = nullptr) {
    std::vector<std::byte> layer;
    if (pass != nullptr) {
      ByteWriter fields(layer);
      pass->write(fields);
    }
    RangeEncoder coder(layer);
    TruthExchange<3, RangeEncoder, QuantizedField<3>> ask(coder, truth, quantized_);
    what(ask);
    coder.finish();
    head.error = distance_.rms(known_.signs, known_.scalars, known_.active);
    head.bytes = layer.size();
    head.checksum = checksum(layer);
    ByteWriter out(bytes_);
    write(out, head);
    bytes_.insert(bytes_.end(), layer.begin(), layer.end());
    ++layers_;
  }

  const GridField<3>& field_;
  const Header& header_;
  const EncodeOptions& options_;
  QuantizedField<3> quantized_;
  SourceDistance<3> distance_;
  Knowledge known_;
  std::vector<std::byte> bytes_;
  uint32_t layers_ = 0;
};

/// How far a crossing may move along an edge for a distance in grid steps along the smallest spacing; edges along
/// several axes only count for tetrahedra.
GeometryCoder<3>::Allowed allowed(const Header& header, double distance) {
  GeometryCoder<3>::Allowed result{};
  for (unsigned axes = 1; axes < result.size(); ++axes) {
    if (header.polygonizer == Polygonizer::Cubes && !std::has_single_bit(axes)) continue;
    result[axes] = static_cast<uint32_t>(std::clamp(65536 * distance / edgeLength(header.placement, axes), 0.0, 65536.0));
  }
  // The last also says whether diagonals count: even where nothing may move they do.
  if (header.polygonizer == Polygonizer::Tetrahedra) result.back() = std::max(result.back(), 1u);
  return result;
}

/// One pass, for all scalars that the stream's polygonizer needs.
void tellPass(LayerWriter& layers, const Header& header, GeometryPass pass) {
  layers.geometry(pass);
  if (header.polygonizer == Polygonizer::Cubes) return;
  pass.members = Members::DiagonalEnds;
  layers.geometry(pass);
}

GeometryPass halving(const Header& header, double distance) {
  return {LayerKind::Halving, Members::AxisEnds, 0, allowed(header, distance), 30, false};
}

/// Octaves, then halvings to half the distance each, until the bound holds.
void tellGeometry(LayerWriter& layers, const Header& header) {
  constexpr double kCoarsest = 0.1;  // octaves alone are nearly as good
  constexpr double kFinestOfLossless = 0.025;
  constexpr double kFinest = 1e-6;  // all is told
  const double bound = header.lossless ? 0 : std::max(double{header.maxError}, kFinest);
  tellPass(layers, header, {LayerKind::Octaves, Members::AxisEnds, bound > 0.3 ? 1 : bound > 0.15 ? 2 : 3, {}, 0, false});
  double distance = header.lossless ? kFinestOfLossless : bound;
  while (distance * 2 <= kCoarsest) distance *= 2;
  for (; distance > (header.lossless ? kFinestOfLossless * 0.9 : bound * 1.1); distance /= header.lossless ? 4 : 2) {
    tellPass(layers, header, halving(header, distance));
  }
  tellPass(layers, header, halving(header, bound));
  if (header.lossless) return;
  // What moves a crossing is judged to first order. Where that was not enough, the bricks concerned go further.
  for (distance = bound / 2; distance > bound / 64; distance /= 2) {
    auto places = layers.beyond(bound);
    if (places.empty()) return;
    layers.select(std::move(places));
    GeometryPass repair = halving(header, distance);
    repair.selective = true;
    tellPass(layers, header, repair);
  }
}

}  // namespace

Error encode(const Volume& volume, const EncodeOptions& options, std::vector<std::byte>& out) {
  const bool bounded = options.lossless || (options.maxError > 0 && std::isfinite(options.maxError));
  if (!bounded || !invertible(volume.placement) || !sensible<3>(volume.samples, volume.size, options.isovalue)) return Error::BadArgument;
  const GridField<3> field(volume.samples, volume.size, options.isovalue);
  Header header = makeHeader(volume, options);
  const auto finest = field.signs(1);
  field.quantize(header, finest);
  header.vertices = countCrossings(finest, activeBricks(finest));
  LayerWriter layers(field, header, options);
  layers.signs(finest);
  if (header.vertices != 0) tellGeometry(layers, header);
  header.layers = layers.layers();
  ByteWriter writer(out);
  write(writer, header);
  out.insert(out.end(), layers.bytes().begin(), layers.bytes().end());
  if (options.progress) options.progress(1);
  return Error::None;
}

}  // namespace isostar
