// The sources of the golden streams: fields and options that use each part of the format, one small
// stream each.
#pragma once

#include "property/delicate_shapes.h"
#include "property/sampled_field.h"

namespace isostar {

struct GoldenSource {
  std::string name;  // of the file, without .isostar
  std::function<Error(std::vector<std::byte>&)> encode;
};

namespace golden {

inline EncodeOptions withBound(double bound) {
  EncodeOptions options;
  options.maxError = bound;
  return options;
}

inline GoldenSource of(const SampledField& field, const EncodeOptions& options) {
  return {field.name,
          [=](std::vector<std::byte>& out) { return encode(field.volume(), options, out); }};
}

inline SampledField knotField(std::string name) {
  const SampledShape<3> shape = knot();
  return {std::move(name), {33, 33, 33}, {shape.values.begin(), shape.values.end()}, {}};
}

/// Whole numbers and a placement: both have fields of their own in the header.
inline SampledField placed() {
  SampledField field = sampled("placed", {11, 9, 13}, [](double x, double y, double z) {
    return std::round(100 * gyroid(9)(x, y, z));
  });
  field.placement = {{-3.5, 10, 0.25}, {0.5, 0.5, 1.25}, {0, -1, 0, 1, 0, 0, 0, 0, 1}};
  return field;
}

/// In 513 chunks of 16 cells: one more than a page of the index names.
inline SampledField twoBalls(std::string name) {
  return sampled(std::move(name), {9, 9, 8209}, [](double x, double y, double z) {
    return 3.2 - std::hypot(x - 4, y - 4, std::min(std::abs(z - 60), std::abs(z - 8202)));
  });
}

inline GoldenSource image(std::string name) {
  const SampledField plane = sampled(std::move(name), {40, 31, 1}, [](double x, double y, double) {
    return std::round(255 * (0.52 + 0.3 * std::sin(0.41 * x) * std::cos(0.33 * y) +
                             0.1 * std::sin(0.9 * x + 0.7 * y))) /
           255;
  });
  EncodeOptions options = withBound(0.02);
  options.isovalue = 0.5;
  return {plane.name, [=](std::vector<std::byte>& out) {
            return encode(Image{plane.samples, {40, 31}}, options, out);
          }};
}

/// The third axis holds four frames of eleven planes each: a ball that grows.
inline GoldenSource sequence(std::string name) {
  const SampledField frames =
      sampled(std::move(name), {12, 10, 44}, [](double x, double y, double z) {
        const double t = std::floor(z / 11);
        return 2.2 + 0.6 * t - std::hypot(x - 5.6, y - 4.7, z - 11 * t - 5.1);
      });
  return {frames.name, [=](std::vector<std::byte>& out) {
            return encode(Sequence{frames.samples, {12, 10, 11}, 4, {}}, withBound(0.1), out);
          }};
}

}  // namespace golden

inline std::vector<GoldenSource> goldenSources() {
  const Size cube{17, 16, 18}, large{40, 33, 36};
  std::vector<GoldenSource> sources{golden::of(sampled("sphere", cube, sphere(cube)), {}),
                                    golden::of(golden::knotField("knot"), golden::withBound(0.2))};
  EncodeOptions options;
  options.polygonizer = Polygonizer::Tetrahedra;
  sources.push_back(golden::of(sampled("tetrahedra", {14, 12, 13}, gyroid(13)), options));
  options.polygonizer = Polygonizer::Cubes;
  options.lossless = true;
  sources.push_back(golden::of(golden::placed(), options));
  options.lossless = false;
  options.furtherIsovalues = {0.4, -0.3};
  sources.push_back(golden::of(sampled("near", cube, torus(cube)), options));
  sources.push_back(golden::of(
      within(halfSpace({0.6, 0.48, 0.64}, 12.7), sampled("trimmed", cube, sphere(cube))), {}));
  options = golden::withBound(0.4);
  options.adaptive = true;
  sources.push_back(golden::of(sampled("adaptive", large, sphere(large, 0.4)), options));
  options = golden::withBound(0.2);
  options.preserveTopology = true;
  sources.push_back(golden::of(golden::knotField("topology"), options));
  options = {};
  options.effort = 2;
  sources.push_back(golden::of(sampled("fitted", {24, 20, 22}, gyroid(17)), options));
  options = golden::withBound(0.2);
  options.chunkSide = 16;
  sources.push_back(golden::of(sampled("chunks", {33, 17, 36}, gyroid(23)), options));
  sources.push_back(golden::of(golden::twoBalls("pages"), options));
  sources.push_back(golden::image("image"));
  sources.push_back(golden::sequence("sequence"));
  sources.push_back(
      golden::of(sampled("empty", {9, 9, 9}, [](double, double, double) { return -1.0; }), {}));
  return sources;
}

}  // namespace isostar
