// Isocontours of images: the same templates in two dimensions (§6).
#include <algorithm>

#include "sampled_image.h"

namespace isostar {
namespace {

using Point = std::pair<float, float>;
using Segments = std::vector<std::pair<Point, Point>>;  // from a point to the next

template <class Visit>
void forImages(Visit visit) {
  for (const ImageSize& size : kImageSizes) {
    for (const SampledImage& image : imagesOf(size)) {
      SCOPED_TRACE(drawn(image));
      visit(image);
    }
  }
}

Point pointAt(const Contours& contours, std::size_t i) {
  return {contours.points[i * 2], contours.points[i * 2 + 1]};
}

bool areClose(const Point& a, const Point& b) {
  return std::abs(a.first - b.first) + std::abs(a.second - b.second) < 2e-5;
}

void expectNear(const std::vector<float>& found, const std::vector<float>& expected, double bound) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], bound);
}

Segments segmentsOf(const Contours& contours) {
  Segments segments;
  for (std::size_t line = 0; line + 1 < contours.starts.size(); ++line) {
    const std::size_t first = contours.starts[line], end = contours.starts[line + 1];
    for (std::size_t i = first; i + 1 < end; ++i)
      segments.emplace_back(pointAt(contours, i), pointAt(contours, i + 1));
    if (line >= contours.open)
      segments.emplace_back(pointAt(contours, end - 1), pointAt(contours, first));
  }
  return segments;
}

/// An independent implementation, cell by cell: each run of positive corners of a cell is cut off.
Segments marchingSquares(const SampledImage& image) {
  Segments segments;
  const std::array<std::array<int32_t, 2>, 4> ring{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (int32_t y = 0; y + 1 < image.size[1]; ++y) {
    for (int32_t x = 0; x + 1 < image.size[0]; ++x) {
      auto scalar = [&](std::size_t i) {
        const auto& c = ring[i % 4];
        return double{
                   image.samples[static_cast<std::size_t>((y + c[1]) * image.size[0] + x + c[0])]} -
               0.5;
      };
      auto crossing = [&](std::size_t i) {
        const auto &a = ring[i % 4], &b = ring[(i + 1) % 4];
        const double t = scalar(i) / (scalar(i) - scalar(i + 1));
        return Point(static_cast<float>(x + a[0] + t * (b[0] - a[0])),
                     static_cast<float>(y + a[1] + t * (b[1] - a[1])));
      };
      for (std::size_t i = 0; i < 4; ++i) {
        if (scalar(i) > 0 || scalar(i + 1) <= 0) continue;
        std::size_t j = i + 1;
        while (scalar(j + 1) > 0) ++j;
        segments.emplace_back(crossing(j), crossing(i));
      }
    }
  }
  return segments;
}

bool onBorder(const Point& p, const ImageSize& size) {
  const auto right = static_cast<float>(size[0] - 1), top = static_cast<float>(size[1] - 1);
  return p.first == 0 || p.second == 0 || p.first == right || p.second == top;
}

void expectSound(const Contours& contours, const ImageSize& size) {
  ASSERT_GE(contours.starts.size(), 1u);
  EXPECT_EQ(contours.starts.front(), 0u);
  EXPECT_EQ(contours.starts.back() * 2, contours.points.size());
  EXPECT_LE(contours.open, contours.starts.size() - 1);
  for (std::size_t i = 0; i < contours.starts.back(); ++i) {
    const auto [x, y] = pointAt(contours, i);
    EXPECT_TRUE(x >= 0 && x <= static_cast<float>(size[0] - 1) && y >= 0 &&
                y <= static_cast<float>(size[1] - 1))
        << x << ", " << y;
  }
  for (std::size_t line = 0; line + 1 < contours.starts.size(); ++line) {
    EXPECT_GE(contours.starts[line + 1] - contours.starts[line], line < contours.open ? 2u : 3u);
    if (line >= contours.open) continue;
    EXPECT_TRUE(onBorder(pointAt(contours, contours.starts[line]), size));
    EXPECT_TRUE(onBorder(pointAt(contours, contours.starts[line + 1] - 1), size));
  }
}

TEST(ImageContours, ofTheSourceAreMarchingSquares) {
  forImages([](const SampledImage& image) {
    const Contours contours = sourceContours(image);
    expectSound(contours, image.size);
    const Segments expected = marchingSquares(image), found = segmentsOf(contours);
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& segment : expected) {
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const auto& s) {
        return areClose(s.first, segment.first) && areClose(s.second, segment.second);
      }));
    }
    EXPECT_EQ(contours.positiveCorner, image.positive(0, 0, 0.5));
  });
}

TEST(ImageContours, areThoseOfTheSourceWhenLossless) {
  forImages([](const SampledImage& image) {
    for (const Polygonizer polygonizer : kPolygonizers) {
      EncodeOptions options;
      options.lossless = true;
      options.polygonizer = polygonizer;
      const Decoder decoder = decoderOf(encoded(image, options));
      EXPECT_EQ(decoder.error(), Error::None);
      EXPECT_TRUE(decoder.isFinal());
      const Contours found = contoursOf(decoder, {.polygonizer = polygonizer}),
                     expected = sourceContours(image, {.polygonizer = polygonizer});
      expectSound(found, image.size);
      EXPECT_EQ(found.starts, expected.starts);
      expectNear(found.points, expected.points,
                 image.name == "bytes" || image.name == "whole numbers" ? 1e-9 : 1e-5);
      EXPECT_EQ(found.open, expected.open);
      EXPECT_EQ(found.positiveCorner, expected.positiveCorner);
    }
  });
}

TEST(ImageContours, keepTheBound) {
  forImages([](SampledImage image) {
    image.origin = {-3, 7};
    image.spacing = {0.5, 2};
    for (const Polygonizer polygonizer : kPolygonizers) {
      for (const double bound : {0.3, 0.05, 0.004}) {
        EncodeOptions options;
        options.maxError = bound;
        options.polygonizer = polygonizer;
        const Contours found =
            contoursOf(decoderOf(encoded(image, options)), {.polygonizer = polygonizer});
        const Contours expected = sourceContours(image, {.polygonizer = polygonizer});
        ASSERT_EQ(found.starts, expected.starts);
        for (std::size_t i = 0; i < found.starts.back(); ++i) {
          const auto [x, y] = pointAt(found, i);
          const auto [sourceX, sourceY] = pointAt(expected, i);
          EXPECT_LE(std::hypot(x - sourceX, y - sourceY), bound * 0.5 + 1e-5);
        }
      }
    }
  });
}

TEST(ImageContours, areSoundForEachPrefix) {
  for (const ImageSize& size : {ImageSize{9, 9}, ImageSize{40, 33}}) {
    for (const SampledImage& image : imagesOf(size)) {
      SCOPED_TRACE(drawn(image));
      const Bytes bytes = encoded(image);
      uint64_t shown = 0;
      for (std::size_t length = 0; length <= bytes.size(); ++length) {
        const Decoder decoder = decoderOf(std::span(bytes).first(length));
        EXPECT_EQ(decoder.error(), length < bytes.size() ? Error::Truncated : Error::None)
            << length;
        EXPECT_GE(decoder.bytes(), shown);
        shown = decoder.bytes();
        for (const Polygonizer polygonizer : kPolygonizers) {
          Contours contours;
          const Error error = decoder.contours({.polygonizer = polygonizer}, contours);
          EXPECT_EQ(error, decoder.ready() ? Error::None : Error::Truncated);
          if (decoder.level() >= 0) expectSound(contours, size);
        }
      }
    }
  }
}

TEST(ImageContours, haveLargerValuesOnTheirLeft) {
  const SampledImage image =
      sampledImage("slope", {9, 9}, [](double x, double) { return x - 3.2; });
  const Contours contours = sourceContours(image);
  ASSERT_EQ(contours.starts.size(), 2u);
  EXPECT_GT(contours.points[1], contours.points.back())
      << "they run downwards: larger values lie on the right of the image";
}

TEST(ImageContours, takeFewerBytesForBytesThanForAnyNumbers) {
  const auto images = imagesOf({64, 64});
  EncodeOptions lossless;
  lossless.lossless = true;
  EXPECT_LT(encoded(images[4], lossless).size() * 2, encoded(images[2], lossless).size());
}

TEST(ImageContours, ofBytesHaveWholeScalars) {
  const SampledImage image = sampledImage(
      "ramp", {256, 2}, [](double x, double y) { return (y == 0 ? x : 255 - x) / 255; });
  EncodeOptions options;
  options.lossless = true;
  EXPECT_LT(encoded(image, options).size(), 512 * 8 / 8) << "512 scalars of 8 bits";
}

TEST(ImageContours, areNotAMesh) {
  const Decoder image = decoderOf(encoded(imagesOf({9, 9})[0]));
  Mesh mesh;
  EXPECT_EQ(image.mesh({}, mesh), Error::BadArgument);
  EXPECT_EQ(image.info().dimension, 2);
  EXPECT_EQ(image.info().size, (Size{9, 9, 1}));
  const Decoder volume = decoderOf(encoded(sampled("sphere", {9, 9, 9}, sphere({9, 9, 9}))));
  Contours contours;
  EXPECT_EQ(volume.contours({}, contours), Error::BadArgument);
}

TEST(ImageContours, ofInvalidSamplesAreRefused) {
  const std::vector<float> samples(12, 1);
  Bytes bytes;
  for (const ImageSize& size :
       {ImageSize{0, 12}, ImageSize{-3, -4}, ImageSize{5, 3}, ImageSize{1 << 28, 1}})
    EXPECT_EQ(encode(Image{samples, size}, {}, bytes), Error::BadArgument);
  EXPECT_EQ(encode(Image{samples, {4, 3}, {0, 0}, {0, 1}}, {}, bytes), Error::BadArgument);
  EXPECT_TRUE(bytes.empty());
}

}  // namespace
}  // namespace isostar
