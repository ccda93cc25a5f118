// Arbitrary layers behind a plausible header, with correct checksums, so that they reach the
// traversals. Some streams are torn. The decoder must stay within any memory limit.
#include "container/stream.h"
#include "fuzz_input.h"
#include "hostile/allocation.h"

using namespace isostar;

namespace {

constexpr std::size_t kMostUncounted = 4u << 20;  // models, as Limits says

/// A small number or an arbitrary one.
double isovalueFrom(FuzzInput& input) {
  return (input.byte() & 1) != 0 ? input.between(-9, 9) / 2.0 : input.number<double>();
}

Header headerFrom(FuzzInput& input) {
  Header header;
  header.dimension = input.between(2, 4);
  for (int32_t& n : header.size) n = input.between(1, header.dimension == 4 ? 20 : 40);
  header.isovalue = isovalueFrom(input);
  const int meshes = input.between(0, 4);
  header.adaptive = meshes == 0;
  header.keepsTopology = meshes == 1;
  header.trimmed = meshes == 4 && header.dimension == 3;
  for (int i = header.adaptive || header.trimmed ? 0 : input.between(0, 3); i > 0; --i)
    header.furtherIsovalues.push_back(isovalueFrom(input));
  header.polygonizer = static_cast<Polygonizer>(input.between(0, 1));
  switch (input.between(0, 3)) {
    case 0:
      header.countWhole(1);
      break;
    case 1:
      header.countWhole(Header::kByteStep);
      break;
    default:
      header.quantizationStep =
          std::ldexp(1.0, input.between(0, 1) != 0 ? -10 : 8 * input.number<int8_t>() - 1);
  }
  return header;
}

/// A kind and level that may follow after `coded` layers of a sound stream.
LayerHead expected(FuzzInput& input, const Header& header, int coded) {
  constexpr int kPasses = 5;  // before further isovalues
  const int finestLevel = header.finestLevel();
  if (coded == 0) return {};
  if (coded <= finestLevel) return {LayerKind::Refinement, coded};
  const int passes = coded - finestLevel - 1;
  if (header.adaptive)
    return {passes % 2 == 0 ? LayerKind::Exponents : LayerKind::Magnitudes,
            std::min(passes / 2, 31)};
  if (header.trimmed && passes == 0) return {LayerKind::Domain, finestLevel};
  constexpr std::array<LayerKind, 4> kKinds{LayerKind::Displacement, LayerKind::Displacement,
                                            LayerKind::Exponents, LayerKind::Magnitudes};
  if (header.furtherIsovalues.empty() || passes < kPasses)
    return {kKinds[static_cast<std::size_t>(input.between(0, 3))], finestLevel};
  const int further = passes - kPasses;
  return {further % 3 == 0 ? LayerKind::FurtherSigns : LayerKind::FurtherGeometry,
          std::min(further / 3 + 1, 31)};
}

void writeLayer(FuzzInput& input, const Header& header, int coded, std::vector<std::byte>& stream) {
  LayerHead head = expected(input, header, coded);
  if (input.between(0, 15) == 0) {
    head.kind = static_cast<LayerKind>(input.between(0, 7));
    head.level = input.between(0, std::max(header.finestLevel(), 3));
  }
  const auto payload = input.bytes(static_cast<std::size_t>(input.byte()));
  head.bytes = payload.size();
  head.checksum = checksum(head, payload, static_cast<std::size_t>(coded));
  ByteWriter out(stream);
  write(out, head);
  stream.insert(stream.end(), payload.begin(), payload.end());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  Header header = headerFrom(input);
  std::vector<std::byte> layers, stream;
  const int count = input.between(0, 20);
  for (int coded = 0; coded < count; ++coded) writeLayer(input, header, coded, layers);
  header.bytes = layers.size();
  ByteWriter out(stream);
  write(out, header);
  stream.insert(stream.end(), layers.begin(), layers.end());
  if ((input.byte() & 1) != 0)
    stream.resize(stream.size() - std::min<std::size_t>(stream.size(), input.byte()));
  Limits limits = kFuzzLimits;
  limits.memory >>= input.between(0, 10);
  const Allocation allocation;
  demandHarmless(stream, limits);
  demand(allocation.peak() <= limits.memory + kMostUncounted + stream.size());
  return 0;
}
