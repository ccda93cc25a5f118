// Limits.memory is kept: what decoders and surfaces take, measured, against what was allowed.
#include "allocation.h"
#include "property/round_trip.h"
#include "property/sampled_image.h"

namespace isostar {
namespace {

/// What a decoder takes beside what is counted, the header's description included: its models, by
/// dimension, and once more those of a mesh that is filled.
constexpr std::array<std::size_t, 5> kUncounted{0, 0, 1u << 20, 11u << 17, 4u << 20};
constexpr std::size_t kUncountedOfMesh = 1u << 20;
constexpr std::size_t kMostModels = 4u << 20;  // as Limits says

struct Spent {
  std::size_t peak = 0;
  bool overLimit = false;
};

bool isTooLarge(const Decoder& decoder, const MeshOptions& options) {
  Mesh mesh;
  Contours contours;
  const Error error = decoder.info().dimension == 2 ? decoder.contours(options, contours)
                                                    : decoder.mesh(options, mesh);
  EXPECT_TRUE(error == Error::None || error == Error::OverLimit) << name(error);
  return error == Error::OverLimit;
}

/// Decodes all, and makes what there is to see after each layer.
Spent spentOn(const Bytes& bytes, std::size_t memory) {
  const Allocation allocation;
  Spent exhausted;
  Decoder decoder({uint64_t{1} << 31, uint64_t{1} << 26, memory});
  decoder.accept(bytes);
  decoder.finish();
  while (decoder.advance()) {
    for (const Polygonizer polygonizer : kPolygonizers) {
      MeshOptions options;
      options.polygonizer = polygonizer;
      options.isovalue = decoder.info().isovalues.back();
      const bool coded = isTooLarge(decoder, options);
      // Between two frames, or between two isovalues.
      options.isovalue = (decoder.info().isovalues.front() + decoder.info().isovalues.back()) / 2;
      options.time = decoder.info().frames > 1 ? 0.5 : 0;
      const bool between = isTooLarge(decoder, options);
      exhausted.overLimit = exhausted.overLimit || coded || between;
    }
  }
  EXPECT_TRUE(decoder.isFinal() || decoder.error() == Error::Truncated ||
              decoder.error() == Error::OverLimit)
      << name(decoder.error());
  exhausted.overLimit = exhausted.overLimit || decoder.error() == Error::OverLimit;
  exhausted.peak = allocation.peak();
  return exhausted;
}

void expectWithin(const Bytes& bytes, int dimension, std::size_t uncounted = 0) {
  const std::size_t beside =
      kUncounted[static_cast<std::size_t>(dimension)] + uncounted + bytes.size();
  const Spent free = spentOn(bytes, SIZE_MAX);
  EXPECT_FALSE(free.overLimit);
  for (std::size_t memory = free.peak / 48; memory < free.peak; memory += 2 * memory - memory / 5) {
    const Spent exhausted = spentOn(bytes, memory);
    EXPECT_LE(exhausted.peak, memory + beside)
        << memory << " bytes allowed; " << free.peak << " would be used";
    EXPECT_TRUE(exhausted.overLimit || memory + beside >= free.peak) << memory;
  }
  // What must be counted beforehand is at most this much more than what is used.
  EXPECT_FALSE(spentOn(bytes, 2 * free.peak).overLimit) << free.peak;
}

TEST(HostileMemory, volumes) {
  EncodeOptions options;
  options.lossless = true;
  const Size cube{50, 61, 57}, flat{300, 3, 250};
  for (const auto& field :
       {sampled("gyroid", cube, gyroid()), sampled("sphere", cube, sphere(cube)),
        sampled("noise", {30, 24, 28}, noise()), sampled("flat", flat, gyroid())}) {
    SCOPED_TRACE(described(field));
    expectWithin(encoded(field, options), 3);
    options.polygonizer = Polygonizer::Tetrahedra;
  }
}

TEST(HostileMemory, closeByIsovalues) {
  const Size size{50, 61, 57};
  EncodeOptions options;
  options.furtherIsovalues = {0.1, -0.4};
  expectWithin(encoded(sampled("gyroid", size, gyroid(17)), options), 3);
}

TEST(HostileMemory, domains) {
  const Size size{50, 61, 57};
  EncodeOptions options;
  for (const Field& domain : {halfSpace({0.6, 0.48, 0.64}, 48), noise(3)}) {
    expectWithin(encoded(within(domain, sampled("gyroid", size, gyroid(17))), options), 3);
    options.polygonizer = Polygonizer::Tetrahedra;
  }
}

TEST(HostileMemory, whatWasSoundIsStillShown) {
  const Size size{50, 61, 57};
  for (const auto& [adaptive, welded] : {std::pair{false, false}, {true, false}, {false, true}}) {
    EncodeOptions options;
    options.adaptive = adaptive;
    options.preserveTopology = welded;
    options.maxError = 0.3;
    const Bytes bytes = encoded(sampled("gyroid", size, gyroid(31)), options);
    for (std::size_t memory = 1 << 14; memory < 2u << 20; memory *= 2) {
      const Decoder decoder = decoderOf(bytes, {1u << 20, 1u << 20, memory});
      if (decoder.error() == Error::None || decoder.level() < 0) continue;
      EXPECT_EQ(decoder.error(), Error::OverLimit);
      const Decoder before = decoderOf(std::span(bytes).first(decoder.bytes()));
      EXPECT_EQ(decoder.level(), before.level()) << memory;
      Mesh mesh;
      if (decoder.mesh({}, mesh) != Error::None || adaptive) continue;
      EXPECT_EQ(mesh.indices, meshOf(before).indices) << memory;
    }
  }
}

TEST(HostileMemory, adaptiveVolumes) {
  EncodeOptions options;
  options.adaptive = true;
  options.maxError = 0.3;
  const Size size{70, 61, 66};
  for (const auto& field :
       {sampled("sphere", size, sphere(size)), sampled("gyroid", size, gyroid(31))}) {
    SCOPED_TRACE(described(field));
    expectWithin(encoded(field, options), 3);
  }
}

TEST(HostileMemory, streamsOfOneTopology) {
  EncodeOptions options;
  options.preserveTopology = true;
  const Size size{50, 61, 57};
  for (const auto& field :
       {sampled("sphere", size, sphere(size)), sampled("gyroid", size, gyroid(23)),
        sampled("rough", size, [](double x, double y, double z) {
          return gyroid(23)(x, y, z) + 0.4 * noise(3)(x, y, z);
        })}) {
    SCOPED_TRACE(described(field));
    expectWithin(encoded(field, options), 3, kUncountedOfMesh);
  }
}

TEST(HostileMemory, images) {
  for (const SampledImage& image : imagesOf({300, 250})) {
    SCOPED_TRACE(image.name);
    expectWithin(encoded(image), 2);
  }
}

Bytes sequence() {
  const Size size{25, 19, 30};
  std::vector<float> samples;
  for (int t = 0; t < 12; ++t) {
    const SampledField frame = sampled("frame", size, [=](double x, double y, double z) {
      return gyroid(13)(x + t, y, z - 0.3 * t);
    });
    samples.insert(samples.end(), frame.samples.begin(), frame.samples.end());
  }
  Bytes bytes;
  EXPECT_EQ(encode(Sequence{samples, size, 12, {}}, {}, bytes), Error::None);
  return bytes;
}

TEST(HostileMemory, sequences) {
  expectWithin(sequence(), 4);
}

/// Of octaves and of displacements that end within: what is told is shown as a mesh, which has
/// models of its own.
TEST(HostileMemory, tornLayers) {
  const Size size{50, 61, 57};
  for (const auto& [dimension, bytes] : {std::pair{2, encoded(imagesOf({300, 250})[3])},
                                         {3, encoded(sampled("gyroid", size, gyroid(17)))},
                                         {4, sequence()}}) {
    for (const LayerInfo& layer : infoOf(bytes).layers) {
      const Bytes prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(
                                                            layer.offset - layer.bytes / 4));
      const std::size_t beside =
          std::min(kUncounted[static_cast<std::size_t>(dimension)] + kUncountedOfMesh,
                   kMostModels) +
          prefix.size();
      for (std::size_t memory = 1u << 16; memory < 16u << 20; memory *= 2) {
        EXPECT_LE(spentOn(prefix, memory).peak, memory + beside)
            << dimension << " dimensions, " << layer.kind << ' ' << layer.level << ", " << memory;
      }
    }
  }
}

}  // namespace
}  // namespace isostar
