// Writes small sound streams and files as corpora for the fuzzers, a folder for each kind:
// write_seeds FOLDER.
#include <filesystem>
#include <iostream>

#include "property/sampled_field.h"
#include "reader_seeds.h"
#include "seed_folder.h"

namespace {

using namespace isostar;

class StreamSeeds {
 public:
  explicit StreamSeeds(const std::filesystem::path& folder) : folder_(folder) {}

  template <class Source>
  void write(const Source& source, const EncodeOptions& options) {
    std::vector<std::byte> stream;
    StreamInfo info;
    if (encode(source, options, stream) != Error::None || inspect(stream, info) != Error::None ||
        info.adaptive != options.adaptive) {
      std::cerr << "seed " << number() << " could not be written as intended\n";
      allAsIntended_ = false;
    }
    folder_.write({reinterpret_cast<const char*>(stream.data()), stream.size()});
  }
  [[nodiscard]] int number() const { return folder_.number(); }
  [[nodiscard]] bool allAsIntended() const { return allAsIntended_; }

 private:
  SeedFolder folder_;
  bool allAsIntended_ = true;
};

EncodeOptions optionsOf(int number) {
  EncodeOptions options;
  options.polygonizer = static_cast<Polygonizer>(number % 2);
  options.lossless = number % 3 == 0;
  options.effort = 1 + number / 2 % 2;
  return options;
}

void writeVolumes(StreamSeeds& seeds) {
  for (const Size& size : {Size{2, 2, 2}, Size{5, 4, 6}, Size{17, 9, 12}}) {
    for (const auto& field : fieldsOf(size)) seeds.write(field.volume(), optionsOf(seeds.number()));
  }
}

void writeFurtherIsovalues(StreamSeeds& seeds) {
  for (const auto& field : fieldsOf({9, 8, 11})) {
    EncodeOptions options = optionsOf(seeds.number());
    options.furtherIsovalues = {0.3, -0.2, 3};
    seeds.write(field.volume(), options);
  }
}

EncodeOptions adaptive(double bound, Polygonizer polygonizer, int effort = 1) {
  EncodeOptions options;
  options.effort = effort;
  options.adaptive = true;
  options.maxError = bound;
  options.polygonizer = polygonizer;
  return options;
}

/// Round shapes with as few samples as possible for which the adaptive stream is still the smaller
/// one: fuzzers decode them often.
void writeAdaptiveMeshes(StreamSeeds& seeds) {
  const Size cube{24, 24, 24}, box{22, 24, 21};
  seeds.write(sampled("ball", cube, sphere(cube, 0.45)).volume(), adaptive(1, Polygonizer::Cubes));
  seeds.write(sampled("ball", cube, sphere(cube, 0.45)).volume(),
              adaptive(1, Polygonizer::Tetrahedra, 2));
  seeds.write(sampled("ball", box, sphere(box, 0.45)).volume(),
              adaptive(0.9, Polygonizer::Tetrahedra));
  const SampledField disc = sampled("disc", {33, 28, 1}, [](double x, double y, double) {
    return 11.23 - std::hypot(x - 16.5, y - 14);
  });
  seeds.write(Image{disc.samples, {33, 28}}, adaptive(0.8, Polygonizer::Tetrahedra));
}

void writeDomains(StreamSeeds& seeds) {
  for (const auto& field : fieldsOf({9, 8, 11}))
    seeds.write(within(halfSpace({0.6, 0.48, 0.64}, 8), field).volume(), optionsOf(seeds.number()));
}

void writeVolumesOfOneTopology(StreamSeeds& seeds) {
  for (const auto& field : fieldsOf({13, 11, 10})) {
    EncodeOptions options = optionsOf(seeds.number());
    options.preserveTopology = true;
    seeds.write(field.volume(), options);
  }
}

/// Images: planes of fields.
void writeImages(StreamSeeds& seeds) {
  for (const auto& field : fieldsOf({21, 14, 1})) {
    EncodeOptions options = optionsOf(seeds.number());
    if (seeds.number() % 4 == 0) options.furtherIsovalues = {0.5};
    seeds.write(Image{field.samples, {21, 14}}, options);
  }
}

/// The third axis of a field holds three frames of four planes each.
void writeSequences(StreamSeeds& seeds) {
  for (const auto& field : fieldsOf({6, 5, 12}))
    seeds.write(Sequence{field.samples, {6, 5, 4}, 3, {}}, optionsOf(seeds.number()));
}

/// Inputs of round_trip_fuzz: options, a size of at most 4 × 4 × 4, a kind of samples, samples.
void writeRoundTrips(SeedFolder seeds) {
  constexpr std::size_t kOptions = 7, kSamples = 64 * sizeof(float);
  constexpr uint64_t kMultiplier = 6364136223846793005, kIncrement = 1442695040888963407;
  uint64_t state = 1;
  const auto byte = [&] {
    state = state * kMultiplier + kIncrement;
    return static_cast<char>(state >> 56);
  };
  for (int i = 0; i < 32; ++i) {
    std::string input;
    for (std::size_t option = 0; option < kOptions; ++option) input += byte();
    input[kOptions - 1] = 0;  // no further isovalues: their bytes would follow
    input += byte();          // best effort
    for (int axis = 0; axis < 3; ++axis) input += static_cast<char>(1 + (byte() & 1) + (i & 1));
    input += static_cast<char>(i / 2 % 4);
    while (input.size() < kSamples) input += byte();
    seeds.write(input);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  writeReaderSeeds(folder);
  writeRoundTrips(SeedFolder(folder / "round_trip"));
  StreamSeeds seeds(folder / "streams");
  writeVolumes(seeds);
  writeFurtherIsovalues(seeds);
  writeAdaptiveMeshes(seeds);
  writeDomains(seeds);
  writeVolumesOfOneTopology(seeds);
  writeImages(seeds);
  writeSequences(seeds);
  return seeds.allAsIntended() ? 0 : 1;
}
