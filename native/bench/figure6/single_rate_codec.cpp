#include "bench/figure6/single_rate_codec.h"

#include "bench/figure6/distance_samples.h"
#include "bench/figure6/leaf_field.h"
#include "bench/figure6/scalar_coder.h"
#include "bench/figure6/volume_signs.h"
#include "container/bytes.h"
#include "bisection/criteria.h"
#include "bisection/adaptation.h"
#include "coding/adaptive/gate_traversal.h"

namespace isostar::bench {
namespace {

// Of the bound. Scalars are off by half their step, which adds to the flatness of leaves only in the worst case.
constexpr double kFlat = 0.8, kQuantized = 1.1;

struct Visit {
  TaggedSimplex<3> leaf, from;
  int fresh = -1;  // of a component's first leaf, which comes from nowhere
};

/// Both directions: `ask` has the mesh or nothing.
template <class Ask>
std::vector<Visit> tellMesh(Ask& ask, GateTraversal<3>& traversal) {
  std::vector<Visit> visits;
  traversal.tell(ask, [&](const auto& leaf, const auto* from, int fresh) {
    visits.push_back({leaf, from != nullptr ? *from : leaf, from != nullptr ? fresh : -1});
  });
  return visits;
}

/// The same: truth(sample) is the scalar or anything.
template <class Coder, class Truth>
void tellScalars(Coder& coder, const std::vector<Visit>& visits, const GateTraversal<3>& traversal,
                 ScalarCoder& scalars, Truth truth) {
  const auto positive = [&](const Coordinates<3>& sample) { return traversal.positive(sample); };
  for (const auto& [leaf, from, fresh] : visits)
    scalars.tell(coder, leaf, fresh < 0 ? nullptr : &from, fresh, positive, truth);
}

SingleRateStream encoded(const Rbmt<3>& mesh, const Signs<3>& signs, const DistanceSamples& distances, double step) {
  SingleRateStream stream;
  ByteWriter header(stream.bytes);
  for (int32_t last : mesh.hierarchy().box()) header.varint(static_cast<uint64_t>(last) + 1);
  const auto rounded = static_cast<float>(step);
  header.f32(rounded);
  RangeEncoder coder(stream.bytes);
  MeshTruth<3, RangeEncoder> ask(coder, mesh, signs);
  GateTraversal<3> traversal(mesh.hierarchy());
  ScalarCoder scalars(mesh.hierarchy(), double{rounded});
  const auto visits = tellMesh(ask, traversal);
  stream.connectivity = stream.bytes.size();
  stream.leaves = visits.size();
  tellScalars(coder, visits, traversal, scalars, [&](const auto& sample) { return distances(sample); });
  stream.vertices = scalars.count();
  coder.finish();
  return stream;
}

}  // namespace

std::vector<SingleRateStream> encodeSingleRate(const Volume& volume, double isovalue,
                                               const measure::TriangleTree& surface, std::span<const double> bounds) {
  const Signs<3> signs = signsOf(volume, isovalue);
  const DistanceSamples distances(volume, isovalue, signs, surface);
  const Hierarchy<3> hierarchy(lastSample(volume.size), octavesOf(volume.size));
  const auto source = [&](const Coordinates<3>& v) { return distances.source(v); };
  std::vector<SingleRateStream> streams;
  for (double bound : bounds) {
    Rbmt<3> mesh(hierarchy);
    const DistanceBound<3, DistanceSamples, decltype(source)> near(hierarchy, signs, distances, source, kFlat * bound);
    refine(mesh, [&](const TaggedSimplex<3>& s) { return !mayCross(signs, hierarchy, s) || near(s); });
    streams.push_back(encoded(mesh, signs, distances, kQuantized * bound));
  }
  return streams;
}

SampledFunction decodeSingleRate(std::span<const std::byte> bytes) {
  SampledFunction result;
  ByteReader header(bytes);
  for (int32_t& side : result.size) side = static_cast<int32_t>(header.varint());
  const double step = double{header.f32()};
  const Hierarchy<3> hierarchy(lastSample(result.size), octavesOf(result.size));
  RangeDecoder coder(bytes.subspan(header.position()));
  MeshBlind<3> ask(coder, 8);
  GateTraversal<3> traversal(hierarchy);
  ScalarCoder scalars(hierarchy, step);
  const auto visits = tellMesh(ask, traversal);
  tellScalars(coder, visits, traversal, scalars, [](const auto&) { return 0.0; });
  LeafField field(hierarchy);
  for (const Visit& v : visits) field.add(v.leaf, [&](const auto& sample) { return scalars.value(sample); });
  field.complete(traversal.positive({}));
  result.samples = field.take();
  return result;
}

}  // namespace isostar::bench
