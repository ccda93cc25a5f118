// Arbitrary tiny volumes: lossless streams give the source's triangles, and bounds are kept, at
// each of several isovalues.
#include <algorithm>

#include "fuzz_input.h"

using namespace isostar;

namespace {

Volume volumeFrom(FuzzInput& input, std::vector<float>& samples) {
  Volume volume;
  std::size_t count = 1;
  for (int32_t& n : volume.size) count *= static_cast<std::size_t>(n = input.between(1, 9));
  const bool whole = (input.byte() & 1) != 0;
  // Of similar magnitude: scalars are quantized relative to the largest at the surface.
  const float scale = whole ? 1 : std::ldexp(1.37F, input.between(-60, 60));
  for (std::size_t i = 0; i < count; ++i)
    samples.push_back(scale *
                      static_cast<float>(whole ? input.number<int8_t>() : input.number<int16_t>()));
  volume.samples = samples;
  return volume;
}

Mesh decoded(const std::vector<std::byte>& stream, const MeshOptions& options) {
  Decoder decoder(kFuzzLimits);
  decoder.accept(stream);
  decoder.finish();
  while (decoder.advance()) {
  }
  Mesh mesh;
  demand(decoder.isFinal() && decoder.error() == Error::None &&
         decoder.mesh(options, mesh) == Error::None);
  return mesh;
}

bool distinct(const EncodeOptions& options) {
  std::vector<double> all = options.furtherIsovalues;
  all.push_back(options.isovalue);
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) == all.end();
}

/// The surface of one of the stream's isovalues has the source's triangles, and vertices within the
/// bound.
void demandKept(const Volume& volume, const EncodeOptions& options, double isovalue,
                const std::vector<std::byte>& stream) {
  MeshOptions grid{options.polygonizer, Frame::Grid, true};
  Mesh source;
  demand(polygonize(volume, isovalue, grid, source) == Error::None);
  grid.isovalue = isovalue;
  const Mesh mesh = decoded(stream, grid);
  demand(mesh.indices == source.indices && mesh.positions.size() == source.positions.size());
  const double bound = options.lossless ? 0 : options.maxError;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    double squares = 0;
    for (std::size_t a = 0; a < 3; ++a)
      squares += std::pow(double{mesh.positions[i + a]} - source.positions[i + a], 2);
    demand(std::sqrt(squares) <= bound + 1e-4);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  EncodeOptions options;
  options.polygonizer = static_cast<Polygonizer>(input.between(0, 1));
  options.lossless = input.between(0, 1) == 1;
  options.preserveTopology = input.between(0, 3) == 0;
  options.maxError = input.between(1, 100) / 200.0;
  options.effort = input.between(1, 2);
  options.isovalue = input.between(0, 3) / 2.0;
  for (int i = input.between(0, 5) / 2; i > 0; --i)
    options.furtherIsovalues.push_back(options.isovalue + i * input.between(1, 9) / 4.0);
  std::vector<float> samples;
  const Volume volume = volumeFrom(input, samples);
  std::vector<std::byte> stream;
  MeshOptions grid{options.polygonizer, Frame::Grid, true};
  Mesh source;
  const Error error = polygonize(volume, options.isovalue, grid, source);
  demand(encode(volume, options, stream) == (distinct(options) ? error : Error::BadArgument));
  if (error != Error::None || !distinct(options)) return 0;
  demandKept(volume, options, options.isovalue, stream);
  for (const double isovalue : options.furtherIsovalues)
    demandKept(volume, options, isovalue, stream);
  return 0;
}
