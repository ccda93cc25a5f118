// Arbitrary tiny volumes, with fill values too: each surface of a stream has the triangles of the
// source, and its vertices are within the bound of the samples' exact crossings. The encoder may
// refuse where samples differ so much that 29 bits cannot hold the bound.
#include <algorithm>
#include <limits>

#include "exact_surface.h"
#include "fuzz_input.h"

using namespace isostar;

namespace {

constexpr double kLossless = 1.0 / (1 << 14);  // as EncodeOptions::lossless says
constexpr double kFloats = 2e-6;               // of coordinates up to 8 in single precision
enum class Samples { Whole, Alike, Filled, Any };

/// Whole numbers, numbers of similar magnitude, the same with fill values, or any floats.
float sampleFrom(FuzzInput& input, Samples kind, float scale) {
  constexpr std::array<float, 8> kFills{1e10F, 9.96921e36F, -3.4e38F, -9999,
                                        1e6F,  1e-42F,      -0.0F,    0};
  if (kind == Samples::Whole) return static_cast<float>(input.number<int8_t>());
  if (kind == Samples::Any) {
    const auto any = input.number<float>();
    return std::isfinite(any) ? any : 0;
  }
  const auto alike = scale * static_cast<float>(input.number<int16_t>());
  if (kind == Samples::Filled && input.between(0, 7) == 0)
    return kFills[static_cast<std::size_t>(input.between(0, 7))];
  return alike;
}

Volume volumeFrom(FuzzInput& input, std::vector<float>& samples) {
  Volume volume;
  std::size_t count = 1;
  for (int32_t& n : volume.size) count *= static_cast<std::size_t>(n = input.between(1, 9));
  const auto kind = static_cast<Samples>(input.between(0, 3));
  const float scale = std::ldexp(1.37F, input.between(-60, 60));
  for (std::size_t i = 0; i < count; ++i) samples.push_back(sampleFrom(input, kind, scale));
  volume.samples = samples;
  return volume;
}

EncodeOptions optionsFrom(FuzzInput& input) {
  EncodeOptions options;
  options.polygonizer = static_cast<Polygonizer>(input.between(0, 1));
  options.lossless = input.between(0, 1) == 1;
  options.preserveTopology = input.between(0, 3) == 0;
  options.maxError = input.between(1, 100) / 200.0;
  options.effort = input.between(1, 2);
  options.isovalue = input.between(0, 3) / 2.0;
  for (int i = input.between(0, 5) / 2; i > 0; --i)
    options.furtherIsovalues.push_back(options.isovalue + i * input.between(1, 9) / 4.0);
  options.bestEffort = input.between(0, 3) == 0;
  return options;
}

std::vector<double> isovaluesOf(const EncodeOptions& options) {
  std::vector<double> all = options.furtherIsovalues;
  all.push_back(options.isovalue);
  return all;
}

bool distinct(std::vector<double> isovalues) {
  std::sort(isovalues.begin(), isovalues.end());
  return std::adjacent_find(isovalues.begin(), isovalues.end()) == isovalues.end();
}

double boundOf(const EncodeOptions& options) {
  return options.lossless ? kLossless : options.maxError;
}

bool areWhole(const std::vector<float>& samples) {
  return std::all_of(samples.begin(), samples.end(), [](float sample) {
    return sample == std::round(sample) && std::abs(sample) < 1 << 16;
  });
}

Decoder decoded(const std::vector<std::byte>& stream) {
  Decoder decoder(kFuzzLimits);
  decoder.accept(stream);
  decoder.finish();
  while (decoder.advance()) {
  }
  demand(decoder.isFinal() && decoder.error() == Error::None);
  return decoder;
}

/// The largest distance of the vertices of a stream's surface from the source's.
double largestDistance(const Decoder& decoder, const ExactSurface& source,
                       const EncodeOptions& options, double isovalue) {
  MeshOptions shown{options.polygonizer, Frame::Grid, true};
  shown.isovalue = isovalue;
  Mesh mesh;
  demand(decoder.mesh(shown, mesh) == Error::None);
  demandSound(mesh);
  demand(mesh.indices == source.indices() &&
         mesh.positions.size() == 3 * source.crossings().size());
  double largest = 0;
  for (std::size_t i = 0; i < source.crossings().size(); ++i) {
    const auto& exact = source.crossings()[i].position;
    double squares = 0;
    for (std::size_t a = 0; a < 3; ++a)
      squares += std::pow(double{mesh.positions[3 * i + a]} - exact[a], 2);
    largest = std::max(largest, std::sqrt(squares));
  }
  return largest;
}

/// May no quantization step of 29 bits hold the bound for all crossings? The factor is for steps
/// that are powers of two, diagonals and the encoder's choice of a step.
bool isExtreme(const std::vector<ExactSurface>& sources, const EncodeOptions& options) {
  constexpr double kSlack = 64, kMost = 1 << 29;
  double largest = 0, least = std::numeric_limits<double>::infinity();
  for (const ExactSurface& source : sources) {
    for (const ExactCrossing& crossing : source.crossings()) {
      largest = std::max({largest, crossing.positive, crossing.negative});
      least = std::min(least, crossing.positive + crossing.negative);
    }
  }
  const auto isovalues = isovaluesOf(options);
  const auto [lowest, highest] = std::minmax_element(isovalues.begin(), isovalues.end());
  return (largest + *highest - *lowest) / least > kMost * boundOf(options) / kSlack;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  const EncodeOptions options = optionsFrom(input);
  std::vector<float> samples;
  const Volume volume = volumeFrom(input, samples);
  std::vector<std::byte> stream;
  EncodeReport report;
  const Error error = encode(volume, options, stream, &report);
  demand(stream.empty() == (error != Error::None));
  if (!distinct(isovaluesOf(options))) {
    demand(error == Error::BadArgument);
    return 0;
  }
  std::vector<ExactSurface> sources;
  for (const double isovalue : isovaluesOf(options))
    sources.emplace_back(volume, isovalue, options.polygonizer);
  if (error != Error::None) {
    demand(error == Error::BadArgument && !report.holds && !options.bestEffort &&
           isExtreme(sources, options));
    return 0;
  }
  const Decoder decoder = decoded(stream);
  demand(report.holds || options.bestEffort);
  const double bound = !report.holds                           ? decoder.info().maxError
                       : options.lossless && areWhole(samples) ? 0
                                                               : boundOf(options);
  for (std::size_t i = 0; i < sources.size(); ++i)
    demand(largestDistance(decoder, sources[i], options, isovaluesOf(options)[i]) <=
           bound + kFloats);
  return 0;
}
