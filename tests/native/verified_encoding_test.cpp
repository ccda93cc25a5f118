// What `encode --adaptive` promises, measured on its output both ways.
#include <gtest/gtest.h>

#include <cmath>

#include "command_line.h"
#include "isostar/isostar.h"
#include "measure/ribbon.h"
#include "measure/surface_distance.h"

namespace isostar::native {
namespace {

/// The contours of the whole stream in a file.
Contours contoursIn(const std::string& file) {
  const auto* bytes = reinterpret_cast<const std::byte*>(file.data());
  Decoder decoder;
  decoder.accept({bytes, file.size()});
  decoder.finish();
  while (decoder.advance()) {
  }
  Contours contours;
  EXPECT_EQ(decoder.contours({}, contours), Error::None);
  return contours;
}

TEST_F(CommandLine, adaptiveContoursKeepTheirBoundBothWays) {
  constexpr int kSide = 96;
  // Rings whose spacing shrinks, with a thin gap: coarse cells lie beside fine ones.
  std::vector<float> samples;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const double r = std::hypot(i - 40.3, j - 51.7);
      samples.push_back(static_cast<float>(std::sin(r * r / 160) + 0.15 * std::cos(0.4 * i)));
    }
  write("rings.nrrd",
        "NRRD0004\ntype: float\ndimension: 2\nsizes: 96 96\nencoding: raw\n"
        "endian: little\n\n" +
            bytesOf(samples));
  Contours source;
  ASSERT_EQ(polygonize(Image{.samples = samples, .size = {kSide, kSide}}, 0.1, {}, source),
            Error::None);
  for (const char* bound : {"0.1", "0.25", "0.5"}) {
    ASSERT_EQ(run({"encode", "rings.nrrd", "x.isostar", "--iso", "0.1", "--adaptive", "--max-error",
                   bound})
                  .status,
              0);
    const auto distance = measure::surfaceDistance(
        measure::ribbon(contoursIn(read("x.isostar")), 1), measure::ribbon(source, 1));
    ASSERT_TRUE(distance.has_value());
    EXPECT_LE(distance->symmetric().max, std::stod(bound) + 1e-5);
  }
}

}  // namespace
}  // namespace isostar::native
