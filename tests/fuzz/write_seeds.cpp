// Writes small sound streams as a corpus for the fuzzers: write_seeds FOLDER.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "property/sampled_field.h"

namespace {

using namespace isostar;

class SeedFolder {
 public:
  explicit SeedFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }

  template <class Source>
  void write(const Source& source, const EncodeOptions& options) {
    std::vector<std::byte> stream;
    StreamInfo info;
    if (encode(source, options, stream) != Error::None || inspect(stream, info) != Error::None ||
        info.adaptive != options.adaptive) {
      std::cerr << "seed " << number_ << " could not be written as intended\n";
      allAsIntended_ = false;
    }
    std::ofstream(folder_ / std::to_string(number_++), std::ios::binary)
        .write(reinterpret_cast<const char*>(stream.data()),
               static_cast<std::streamsize>(stream.size()));
  }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool allAsIntended() const { return allAsIntended_; }

 private:
  std::filesystem::path folder_;
  int number_ = 0;
  bool allAsIntended_ = true;
};

EncodeOptions optionsOf(int number) {
  EncodeOptions options;
  options.polygonizer = static_cast<Polygonizer>(number % 2);
  options.lossless = number % 3 == 0;
  options.effort = 1 + number / 2 % 2;
  return options;
}

void writeVolumes(SeedFolder& seeds) {
  for (const Size& size : {Size{2, 2, 2}, Size{5, 4, 6}, Size{17, 9, 12}}) {
    for (const auto& field : fieldsOf(size)) seeds.write(field.volume(), optionsOf(seeds.number()));
  }
}

void writeFurtherIsovalues(SeedFolder& seeds) {
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
void writeAdaptiveMeshes(SeedFolder& seeds) {
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

void writeDomains(SeedFolder& seeds) {
  for (const auto& field : fieldsOf({9, 8, 11}))
    seeds.write(within(halfSpace({0.6, 0.48, 0.64}, 8), field).volume(), optionsOf(seeds.number()));
}

void writeVolumesOfOneTopology(SeedFolder& seeds) {
  for (const auto& field : fieldsOf({13, 11, 10})) {
    EncodeOptions options = optionsOf(seeds.number());
    options.preserveTopology = true;
    seeds.write(field.volume(), options);
  }
}

/// Images: planes of fields.
void writeImages(SeedFolder& seeds) {
  for (const auto& field : fieldsOf({21, 14, 1})) {
    EncodeOptions options = optionsOf(seeds.number());
    if (seeds.number() % 4 == 0) options.furtherIsovalues = {0.5};
    seeds.write(Image{field.samples, {21, 14}}, options);
  }
}

/// The third axis of a field holds three frames of four planes each.
void writeSequences(SeedFolder& seeds) {
  for (const auto& field : fieldsOf({6, 5, 12}))
    seeds.write(Sequence{field.samples, {6, 5, 4}, 3, {}}, optionsOf(seeds.number()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  SeedFolder seeds(argv[1]);
  writeVolumes(seeds);
  writeFurtherIsovalues(seeds);
  writeAdaptiveMeshes(seeds);
  writeDomains(seeds);
  writeVolumesOfOneTopology(seeds);
  writeImages(seeds);
  writeSequences(seeds);
  return seeds.allAsIntended() ? 0 : 1;
}
