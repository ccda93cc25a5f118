#include <algorithm>
#include <cmath>

#include "field.h"
#include "isostar/isostar.h"
#include "layers.h"
#include "source_distance.h"

namespace isostar {
namespace {

bool sensible(const Volume& v, const EncodeOptions& o) {
  uint64_t samples = 1;
  for (int32_t n : v.size) {
    if (n < 1 || n >= (1 << 28)) return false;
    samples *= static_cast<uint64_t>(n);
    if (samples > v.samples.size()) return false;
  }
  return samples == v.samples.size() && std::isfinite(o.isovalue) && (o.lossless || (o.maxError > 0 && std::isfinite(o.maxError))) &&
         std::all_of(v.samples.begin(), v.samples.end(), [](float s) { return std::isfinite(s); });
}

Header makeHeader(const Volume& volume, const EncodeOptions& options) {
  Header h;
  h.size = volume.size;
  h.placement = volume.placement;
  h.isovalue = options.isovalue;
  h.polygonizer = options.polygonizer;
  h.lossless = options.lossless;
  h.maxError = options.lossless ? 0 : static_cast<float>(options.maxError);
  while (std::ranges::any_of(h.base().last, [](int32_t last) { return last > Header::kMostBaseCells; })) ++h.octaves;
  return h;
}

/// Tells layers one after the other.
class LayerWriter {
 public:
  LayerWriter(const VolumeField& field, const Header& header, const EncodeOptions& options)
      : field_(field), header_(header), options_(options), quantized_(field, header), distance_(field, header), known_(header) {}

  void signs() {
    for (int level = 0; level <= header_.octaves; ++level) {
      const auto truth = field_.signs(int32_t{1} << (header_.octaves - level));
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

  /// Tells a last pass so that no vertex is off by more than the bound: repeats it with less allowed where need be.
  void geometryWithin(GeometryPass pass, double bound) {
    const Knowledge before = known_;
    const std::size_t size = bytes_.size();
    for (int tries = 0;; ++tries) {
      geometry(pass);
      if (tries == 8 || distance_.largest(known_.signs, known_.scalars, header_.polygonizer) <= bound) return;
      known_ = before;
      bytes_.resize(size);
      --layers_;
      for (uint32_t& a : pass.allowed) a -= a / 16;
    }
  }

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
    TruthExchange<3, RangeEncoder, QuantizedField> ask(coder, truth, quantized_);
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

  const VolumeField& field_;
  const Header& header_;
  const EncodeOptions& options_;
  QuantizedField quantized_;
  SourceDistance distance_;
  Knowledge known_;
  std::vector<std::byte> bytes_;
  uint32_t layers_ = 0;
};

/// How far a crossing may move along an edge of each axis, 1/65536 of it, for a distance in grid steps along the
/// smallest spacing.
std::array<uint32_t, 3> allowed(const Placement& placement, double distance) {
  const double smallest = std::ranges::min(placement.spacing);
  std::array<uint32_t, 3> result;
  for (std::size_t a = 0; a < 3; ++a) {
    result[a] = static_cast<uint32_t>(std::clamp(65536 * distance * smallest / placement.spacing[a], 0.0, 65536.0));
  }
  return result;
}

void tellGeometry(LayerWriter& layers, const Volume& volume, const EncodeOptions& options) {
  constexpr double kCoarsest = 0.1;  // the first pass alone is nearly as good
  const bool both = options.polygonizer == Polygonizer::Tetrahedra;
  auto forMembers = [&](GeometryPass pass, bool last) {
    for (const Members members : {Members::AxisEnds, Members::DiagonalEnds}) {
      pass.members = members;
      const bool final = members == (both ? Members::DiagonalEnds : Members::AxisEnds);
      if (last && final && !options.lossless) layers.geometryWithin(pass, options.maxError);
      else layers.geometry(pass);
      if (final) return;
    }
  };
  const double bound = options.lossless ? 0 : options.maxError;
  forMembers({LayerKind::Octaves, Members::AxisEnds, bound > 0.3 ? 1 : bound > 0.15 ? 2 : 3, {}, 0}, false);
  double distance = bound;
  if (options.lossless) distance = 0.025;
  while (distance * 2 <= kCoarsest) distance *= 2;
  for (; distance > bound * 1.001; distance /= options.lossless ? 4 : 2) {
    forMembers({LayerKind::Halving, Members::AxisEnds, 0, allowed(volume.placement, distance), 8}, false);
    if (options.lossless && distance < 0.05) break;
  }
  forMembers({LayerKind::Halving, Members::AxisEnds, 0, allowed(volume.placement, bound), 32}, true);
}

}  // namespace

Error encode(const Volume& volume, const EncodeOptions& options, std::vector<std::byte>& out) {
  if (!sensible(volume, options)) return Error::BadArgument;
  const VolumeField field(volume, options.isovalue);
  Header header = makeHeader(volume, options);
  const auto finest = field.signs(1);
  field.quantize(header, finest);
  header.vertices = countCrossings(finest);
  LayerWriter layers(field, header, options);
  layers.signs();
  if (header.vertices != 0) tellGeometry(layers, volume, options);
  header.layers = layers.layers();
  ByteWriter writer(out);
  write(writer, header);
  out.insert(out.end(), layers.bytes().begin(), layers.bytes().end());
  if (options.progress) options.progress(1);
  return Error::None;
}

}  // namespace isostar
