// Small sound streams of every kind: what fuzzers mutate and what tests damage.
#pragma once

#include "property/sampled_field.h"

namespace isostar {

class StreamSeeds {
 public:
  template <class Source>
  void add(const Source& source, const EncodeOptions& options) {
    std::vector<std::byte> stream;
    StreamInfo info;
    allAsIntended_ = allAsIntended_ && encode(source, options, stream) == Error::None &&
                     inspect(stream, info) == Error::None && info.adaptive == options.adaptive;
    streams_.push_back(std::move(stream));
  }
  [[nodiscard]] int number() const { return static_cast<int>(streams_.size()); }
  [[nodiscard]] const std::vector<std::vector<std::byte>>& streams() const { return streams_; }
  /// Could every stream be encoded, and as an adaptive mesh where that was intended?
  [[nodiscard]] bool allAsIntended() const { return allAsIntended_; }

 private:
  std::vector<std::vector<std::byte>> streams_;
  bool allAsIntended_ = true;
};

namespace seeds {

inline EncodeOptions optionsOf(int number) {
  EncodeOptions options;
  options.polygonizer = static_cast<Polygonizer>(number % 2);
  options.lossless = number % 3 == 0;
  options.effort = 1 + number / 2 % 2;
  return options;
}

inline void addVolumes(StreamSeeds& streams) {
  for (const Size& size : {Size{2, 2, 2}, Size{5, 4, 6}, Size{17, 9, 12}}) {
    for (const auto& field : fieldsOf(size))
      streams.add(field.volume(), optionsOf(streams.number()));
  }
}

inline void addChunks(StreamSeeds& streams) {
  for (const auto& field : fieldsOf({33, 20, 17})) {
    EncodeOptions options = optionsOf(streams.number());
    options.chunkSide = 16;
    options.maxError = 0.3;
    streams.add(field.volume(), options);
  }
}

inline void addFurtherIsovalues(StreamSeeds& streams) {
  for (const auto& field : fieldsOf({9, 8, 11})) {
    EncodeOptions options = optionsOf(streams.number());
    options.furtherIsovalues = {0.3, -0.2, 3};
    streams.add(field.volume(), options);
  }
}

inline EncodeOptions adaptive(double bound, Polygonizer polygonizer, int effort = 1) {
  EncodeOptions options;
  options.effort = effort;
  options.adaptive = true;
  options.maxError = bound;
  options.polygonizer = polygonizer;
  return options;
}

/// Round shapes with as few samples as possible for which the adaptive stream is still the smaller
/// one: fuzzers decode them often.
inline void addAdaptiveMeshes(StreamSeeds& streams) {
  const Size cube{24, 24, 24}, box{22, 24, 21};
  streams.add(sampled("ball", cube, sphere(cube, 0.45)).volume(), adaptive(1, Polygonizer::Cubes));
  streams.add(sampled("ball", cube, sphere(cube, 0.45)).volume(),
              adaptive(1, Polygonizer::Tetrahedra, 2));
  streams.add(sampled("ball", box, sphere(box, 0.45)).volume(),
              adaptive(0.9, Polygonizer::Tetrahedra));
  const SampledField disc = sampled("disc", {33, 28, 1}, [](double x, double y, double) {
    return 11.23 - std::hypot(x - 16.5, y - 14);
  });
  streams.add(Image{disc.samples, {33, 28}}, adaptive(0.8, Polygonizer::Tetrahedra));
}

inline void addDomains(StreamSeeds& streams) {
  for (const auto& field : fieldsOf({9, 8, 11}))
    streams.add(within(halfSpace({0.6, 0.48, 0.64}, 8), field).volume(),
                optionsOf(streams.number()));
}

inline void addVolumesOfOneTopology(StreamSeeds& streams) {
  for (const auto& field : fieldsOf({13, 11, 10})) {
    EncodeOptions options = optionsOf(streams.number());
    options.preserveTopology = true;
    streams.add(field.volume(), options);
  }
}

/// Images: planes of fields.
inline void addImages(StreamSeeds& streams) {
  for (const auto& field : fieldsOf({21, 14, 1})) {
    EncodeOptions options = optionsOf(streams.number());
    if (streams.number() % 4 == 0) options.furtherIsovalues = {0.5};
    streams.add(Image{field.samples, {21, 14}}, options);
  }
}

/// The third axis of a field holds three frames of four planes each.
inline void addSequences(StreamSeeds& streams) {
  for (const auto& field : fieldsOf({6, 5, 12}))
    streams.add(Sequence{field.samples, {6, 5, 4}, 3, {}}, optionsOf(streams.number()));
}

}  // namespace seeds

inline StreamSeeds streamSeeds() {
  StreamSeeds streams;
  seeds::addVolumes(streams);
  seeds::addFurtherIsovalues(streams);
  seeds::addChunks(streams);
  seeds::addAdaptiveMeshes(streams);
  seeds::addDomains(streams);
  seeds::addVolumesOfOneTopology(streams);
  seeds::addImages(streams);
  seeds::addSequences(streams);
  return streams;
}

}  // namespace isostar
