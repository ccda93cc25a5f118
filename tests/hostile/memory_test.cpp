// Limits.memory holds: the measured memory of decoders and surfaces is within the limit.
#include "allocation.h"
#include "property/round_trip.h"
#include "property/sampled_image.h"

namespace isostar {
namespace {

/// Memory beside the limit, by dimension: the decoder's models and the description of the stream.
/// kUncountedOfMesh: the models of a mesh whose absent vertices are filled.
constexpr std::array<std::size_t, 5> kUncounted{0, 0, 1u << 20, 11u << 17, 4u << 20};
constexpr std::size_t kUncountedOfMesh = 1u << 20;
constexpr std::size_t kMostModels = 4u << 20;  // as Limits says

struct MemoryUse {
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

/// Decodes all layers and makes all surfaces after each.
MemoryUse useOf(const Bytes& bytes, std::size_t memory) {
  const Allocation allocation;
  MemoryUse use;
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
      use.overLimit = use.overLimit || coded || between;
    }
  }
  EXPECT_TRUE(decoder.isFinal() || decoder.error() == Error::Truncated ||
              decoder.error() == Error::OverLimit)
      << name(decoder.error());
  use.overLimit = use.overLimit || decoder.error() == Error::OverLimit;
  use.peak = allocation.peak();
  return use;
}

void expectWithin(const Bytes& bytes, int dimension, std::size_t uncounted = 0) {
  const std::size_t beside =
      kUncounted[static_cast<std::size_t>(dimension)] + uncounted + bytes.size();
  const MemoryUse unlimited = useOf(bytes, SIZE_MAX);
  EXPECT_FALSE(unlimited.overLimit);
  for (std::size_t memory = unlimited.peak / 48; memory < unlimited.peak;
       memory += 2 * memory - memory / 5) {
    const MemoryUse use = useOf(bytes, memory);
    EXPECT_LE(use.peak, memory + beside)
        << memory << " bytes allowed; " << unlimited.peak << " would be used";
    EXPECT_TRUE(use.overLimit || memory + beside >= unlimited.peak) << memory;
  }
  // The memory that is counted in advance is at most twice the memory that is used.
  EXPECT_FALSE(useOf(bytes, 2 * unlimited.peak).overLimit) << unlimited.peak;
}

TEST(HostileMemory, volumesStayWithinTheLimit) {
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

TEST(HostileMemory, furtherIsovaluesStayWithinTheLimit) {
  const Size size{50, 61, 57};
  EncodeOptions options;
  options.furtherIsovalues = {0.1, -0.4};
  expectWithin(encoded(sampled("gyroid", size, gyroid(17)), options), 3);
}

TEST(HostileMemory, domainsStayWithinTheLimit) {
  const Size size{50, 61, 57};
  EncodeOptions options;
  for (const Field& domain : {halfSpace({0.6, 0.48, 0.64}, 48), noise(3)}) {
    expectWithin(encoded(within(domain, sampled("gyroid", size, gyroid(17))), options), 3);
    options.polygonizer = Polygonizer::Tetrahedra;
  }
}

TEST(HostileMemory, theLastLayerWithinTheLimitIsShown) {
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

TEST(HostileMemory, adaptiveVolumesStayWithinTheLimit) {
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

TEST(HostileMemory, streamsThatPreserveTopologyStayWithinTheLimit) {
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

TEST(HostileMemory, imagesStayWithinTheLimit) {
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

TEST(HostileMemory, sequencesStayWithinTheLimit) {
  expectWithin(sequence(), 4);
}

/// Torn layers of signs and of displacements are shown as an adaptive mesh, which has its own
/// models.
TEST(HostileMemory, tornLayersStayWithinTheLimit) {
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
        EXPECT_LE(useOf(prefix, memory).peak, memory + beside)
            << dimension << " dimensions, " << layer.kind << ' ' << layer.level << ", " << memory;
      }
    }
  }
}

}  // namespace
}  // namespace isostar
