// Images with known contours, of any size, and a drawing of one for the message of a failing test.
#pragma once

#include "round_trip.h"

namespace isostar {

using ImageSize = std::array<int32_t, 2>;

/// An image that owns its samples.
struct SampledImage {
  std::string name;
  ImageSize size;
  std::vector<float> samples;
  std::array<double, 2> origin{0, 0}, spacing{1, 1};

  [[nodiscard]] Image image() const { return {samples, size, origin, spacing}; }
  [[nodiscard]] bool positive(int32_t x, int32_t y, double isovalue) const {
    return double{samples[static_cast<std::size_t>(y * size[0] + x)]} > isovalue;
  }
};

inline SampledImage sampledImage(std::string name, const ImageSize& size,
                                 const std::function<double(double, double)>& field) {
  SampledImage result{std::move(name), size, {}};
  for (int32_t y = 0; y < size[1]; ++y) {
    for (int32_t x = 0; x < size[0]; ++x) result.samples.push_back(static_cast<float>(field(x, y)));
  }
  return result;
}

/// One image of each kind, all of one size; the isovalue is 0.5.
inline std::vector<SampledImage> imagesOf(const ImageSize& size) {
  const double middleX = 0.5 * (size[0] - 1), middleY = 0.5 * (size[1] - 1),
               radius = 0.35 * std::min(size[0], size[1]);
  auto wave = [](double x, double y) {
    return 0.52 + 0.3 * std::sin(0.41 * x) * std::cos(0.33 * y) + 0.1 * std::sin(0.9 * x + 0.7 * y);
  };
  auto rough = [](double x, double y) { return 0.5 + 0.5 * noise(5)(x, y, 0); };
  return {sampledImage("disc", size,
                       [=](double x, double y) {
                         return 0.5 + radius - std::hypot(x - middleX, y - middleY) + 0.013;
                       }),
          sampledImage("slope", size, [](double x, double y) { return 0.41 * x - 0.7 * y + 0.9; }),
          sampledImage("wave", size, wave),
          sampledImage("noise", size, rough),
          sampledImage("bytes", size,
                       [=](double x, double y) { return std::round(255 * wave(x, y)) / 255.0; }),
          sampledImage("whole numbers", size,
                       [=](double x, double y) { return std::round(9 * rough(x, y)) - 4; }),
          sampledImage("chequers", size, [](double x, double y) { return std::fmod(x + y, 2); }),
          sampledImage("black", size, [](double, double) { return 0.0; }),
          sampledImage("white", size, [](double, double) { return 1.0; })};
}

inline const std::vector<ImageSize> kImageSizes{{2, 2},  {3, 5},  {9, 9},   {33, 20},
                                                {64, 9}, {2, 40}, {100, 77}};

/// Its signs as text, the first row at the bottom.
inline std::string drawn(const SampledImage& image, double isovalue = 0.5) {
  std::string rows = image.name + " of " + std::to_string(image.size[0]) + "x" +
                     std::to_string(image.size[1]) + "\n";
  if (image.size[0] > 120) return rows;
  for (int32_t y = image.size[1] - 1; y >= 0; --y) {
    for (int32_t x = 0; x < image.size[0]; ++x) rows += image.positive(x, y, isovalue) ? '#' : '.';
    rows += '\n';
  }
  return rows;
}

inline Bytes encoded(const SampledImage& image, EncodeOptions options = {}) {
  options.isovalue = 0.5;
  Bytes bytes;
  EXPECT_EQ(encode(image.image(), options, bytes), Error::None) << image.name;
  return bytes;
}

inline Contours contoursOf(const Decoder& decoder, const MeshOptions& options = {}) {
  Contours contours;
  EXPECT_EQ(decoder.contours(options, contours), Error::None);
  return contours;
}

inline Contours sourceContours(const SampledImage& image, const MeshOptions& options = {}) {
  Contours contours;
  EXPECT_EQ(polygonize(image.image(), 0.5, options, contours), Error::None) << image.name;
  return contours;
}

}  // namespace isostar
