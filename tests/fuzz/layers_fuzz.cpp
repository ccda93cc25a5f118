// Any layers behind a plausible header and right checksums: straight into the traversals.
#include "fuzz_input.h"
#include "stream.h"

using namespace isostar;

namespace {

/// A small number or any.
double isovalueFrom(FuzzInput& input) { return (input.byte() & 1) != 0 ? input.between(-9, 9) / 2.0 : input.number<double>(); }

Header headerFrom(FuzzInput& input) {
  Header header;
  header.dimension = input.between(2, 4);
  for (int32_t& n : header.size) n = input.between(1, header.dimension == 4 ? 20 : 40);
  header.isovalue = isovalueFrom(input);
  const int meshes = input.between(0, 4);
  header.adaptive = meshes == 0;
  header.keepsTopology = meshes == 1;
  header.trimmed = meshes == 4 && header.dimension == 3;
  for (int i = header.adaptive || header.trimmed ? 0 : input.between(0, 3); i > 0; --i) header.near.push_back(isovalueFrom(input));
  header.polygonizer = static_cast<Polygonizer>(input.between(0, 1));
  switch (input.between(0, 3)) {
    case 0: header.countWhole(1); break;
    case 1: header.countWhole(Header::kByteStep); break;
    default: header.quantum = std::ldexp(1.0, input.between(0, 1) != 0 ? -10 : 8 * input.number<int8_t>() - 1);
  }
  return header;
}

/// The kind and level that come next in a sound stream of so many layers.
LayerHead expected(const Header& header, int told) {
  if (told == 0) return {};
  if (told <= header.octaves()) return {LayerKind::Refinement, told};
  const int passes = told - header.octaves() - 1;
  if (header.adaptive) return {passes % 2 == 0 ? LayerKind::Octaves : LayerKind::Halving, std::min(passes / 2, 31)};
  constexpr std::array<LayerKind, 3> kPasses{LayerKind::Displacement, LayerKind::Octaves, LayerKind::Halving};
  if (passes < 3) return {kPasses[static_cast<std::size_t>(passes)], header.octaves()};
  return {passes % 3 == 2 ? LayerKind::NearSigns : LayerKind::NearGeometry, std::min(passes / 3 + (passes % 3 == 2 ? 1 : 0), 31)};
}

void writeLayer(FuzzInput& input, const Header& header, int told, std::vector<std::byte>& stream) {
  LayerHead head = expected(header, told);
  if (input.between(0, 3) == 0) {
    head.kind = static_cast<LayerKind>(input.between(0, 7));
    head.level = input.between(0, std::max(header.octaves(), 3));
  }
  const auto payload = input.bytes(static_cast<std::size_t>(input.byte()));
  head.bytes = payload.size();
  head.checksum = checksum(head, payload);
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
  for (int told = 0; told < count; ++told) writeLayer(input, header, told, layers);
  header.bytes = layers.size();
  ByteWriter out(stream);
  write(out, header);
  stream.insert(stream.end(), layers.begin(), layers.end());
  demandHarmless(stream);
  return 0;
}
