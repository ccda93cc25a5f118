#include "bench/figure6/single_rate_codec.h"

#include "bench/figure6/distance_samples.h"
#include "bench/figure6/leaf_field.h"
#include "bench/figure6/scalar_coder.h"
#include "bench/figure6/volume_signs.h"
#include "bisection/adaptation.h"
#include "bisection/criteria.h"
#include "coding/adaptive/gate_traversal.h"
#include "container/bytes.h"

namespace isostar::bench {
namespace {

// As fractions of the bound. Scalars have an error of half their step, which adds to the error of
// flat leaves only in the worst case.
constexpr double kFlat = 0.8, kQuantized = 1.1;

struct Visit {
  TaggedSimplex<3> leaf, from;
  int newVertex = -1;  // -1: a component's first leaf, in which all vertices are new
};

/// Encodes or decodes the mesh: `exchange` is the encoder's or the decoder's side.
template <class Exchange>
std::vector<Visit> codeMesh(Exchange& exchange, GateTraversal<3>& traversal) {
  std::vector<Visit> visits;
  traversal.code(exchange, [&](const auto& leaf, const auto* from, int newVertex) {
    visits.push_back({.leaf = leaf,
                      .from = from != nullptr ? *from : leaf,
                      .newVertex = from != nullptr ? newVertex : -1});
  });
  return visits;
}

/// Encodes or decodes the scalars. When decoding, the result of actual(sample) is ignored.
template <class Coder, class Actual>
void codeScalars(Coder& coder, const std::vector<Visit>& visits, const GateTraversal<3>& traversal,
                 ScalarCoder& scalars, Actual actual) {
  const auto positive = [&](const Coordinates<3>& sample) { return traversal.positive(sample); };
  for (const auto& [leaf, from, newVertex] : visits)
    scalars.code(coder, leaf, newVertex < 0 ? nullptr : &from, newVertex, positive, actual);
}

SingleRateStream encoded(const Rbmt<3>& mesh, const Signs<3>& signs,
                         const DistanceSamples& distances, double step) {
  SingleRateStream stream;
  ByteWriter header(stream.bytes);
  for (int32_t last : mesh.hierarchy().box()) header.varint(static_cast<uint64_t>(last) + 1);
  const auto rounded = static_cast<float>(step);
  header.f32(rounded);
  RangeEncoder coder(stream.bytes);
  MeshEncoderSide<3, RangeEncoder> exchange(coder, mesh, signs);
  GateTraversal<3> traversal(mesh.hierarchy());
  ScalarCoder scalars(mesh.hierarchy(), double{rounded});
  const auto visits = codeMesh(exchange, traversal);
  stream.connectivity = stream.bytes.size();
  stream.leaves = visits.size();
  codeScalars(coder, visits, traversal, scalars,
              [&](const auto& sample) { return distances(sample); });
  stream.vertices = scalars.count();
  coder.finish();
  return stream;
}

}  // namespace

std::vector<SingleRateStream> encodeSingleRate(const Volume& volume, double isovalue,
                                               const measure::TriangleTree& surface,
                                               std::span<const double> bounds) {
  const Signs<3> signs = signsOf(volume, isovalue);
  const DistanceSamples distances(volume, isovalue, signs, surface);
  const Hierarchy<3> hierarchy(lastSample(volume.size), finestLevelOf(volume.size));
  const auto source = [&](const Coordinates<3>& v) { return distances.source(v); };
  std::vector<SingleRateStream> streams;
  for (double bound : bounds) {
    Rbmt<3> mesh(hierarchy);
    const DistanceBound<3, DistanceSamples, decltype(source)> isWithinBound(
        hierarchy, signs, distances, source, kFlat * bound);
    refine(mesh, [&](const TaggedSimplex<3>& s) {
      return !mayCross(signs, hierarchy, s) || isWithinBound(s);
    });
    streams.push_back(encoded(mesh, signs, distances, kQuantized * bound));
  }
  return streams;
}

SampledFunction decodeSingleRate(std::span<const std::byte> bytes) {
  SampledFunction result;
  ByteReader header(bytes);
  for (int32_t& side : result.size) side = static_cast<int32_t>(header.varint());
  const double step = double{header.f32()};
  const Hierarchy<3> hierarchy(lastSample(result.size), finestLevelOf(result.size));
  RangeDecoder coder(bytes.subspan(header.position()));
  MeshDecoderSide<3> exchange(coder, 8);
  GateTraversal<3> traversal(hierarchy);
  ScalarCoder scalars(hierarchy, step);
  const auto visits = codeMesh(exchange, traversal);
  codeScalars(coder, visits, traversal, scalars, [](const auto&) { return 0.0; });
  LeafField field(hierarchy);
  for (const Visit& v : visits)
    field.add(v.leaf, [&](const auto& sample) { return scalars.value(sample); });
  field.complete(traversal.positive({}));
  result.samples = field.take();
  return result;
}

Mesh surfaceOf(const SampledFunction& function) {
  EncodeOptions options;
  options.lossless = true;
  options.bestEffort = true;
  const Volume volume{
      .samples = function.samples, .size = function.size, .placement = {}, .domain = {}};
  std::vector<std::byte> stream;
  Mesh mesh;
  if (encode(volume, options, stream) != Error::None) return mesh;
  Decoder decoder;
  decoder.accept(stream);
  decoder.finish();
  while (decoder.advance()) {
  }
  if (decoder.mesh({.frame = Frame::Grid, .normals = false}, mesh) != Error::None) mesh = {};
  return mesh;
}

}  // namespace isostar::bench
