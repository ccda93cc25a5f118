// Lossless streams: the decoded surface is the one that the polygonizer extracts from the source.
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

/// Vertices are rounded to single precision, so they may differ slightly near the far end of the
/// box.
double rounding(const SampledField& field) {
  return 2e-6 * std::max({field.size[0], field.size[1], field.size[2], 8});
}

void expectSourcesSurface(const SampledField& field, double isovalue = 0) {
  for (const Polygonizer polygonizer : kPolygonizers) {
    SCOPED_TRACE(described(field) + ", " + named(polygonizer));
    EncodeOptions options;
    options.isovalue = isovalue;
    options.lossless = true;
    options.polygonizer = polygonizer;
    const MeshOptions grid{polygonizer, Frame::Grid, true};
    const Mesh source = sourceMesh(field, grid, isovalue),
               mesh = decoded(encoded(field, options), grid);
    expectSound(mesh);
    ASSERT_EQ(mesh.indices, source.indices);
    ASSERT_EQ(mesh.positions.size(), source.positions.size());
    EXPECT_LE(furthest(mesh, source, field.placement), rounding(field));
  }
}

TEST(Lossless, holdsForEachFieldAtEachSize) {
  for (const Size& size : kSizes) {
    for (const auto& field : fieldsOf(size)) expectSourcesSurface(field);
  }
}

TEST(Lossless, boxesWithoutExtentHaveNoSurface) {
  for (const Size& size :
       {Size{1, 1, 1}, Size{1, 9, 1}, Size{1, 8, 9}, Size{20, 1, 33}, Size{17, 40, 1}}) {
    for (const auto& field : fieldsOf(size)) {
      expectSourcesSurface(field);
      EXPECT_TRUE(sourceMesh(field).positions.empty()) << described(field);
    }
  }
}

TEST(Lossless, holdsForAnIsovalueEqualToSamples) {
  for (const Size& size : {Size{2, 2, 2}, Size{17, 16, 9}}) {
    for (auto field : fieldsOf(size)) {
      for (float& s : field.samples) s = std::round(s * 2);
      for (double isovalue : {-1.0, 0.0, 1.0}) expectSourcesSurface(field, isovalue);
    }
  }
}

TEST(Lossless, holdsForIsovaluesBetweenWholeNumbers) {
  auto field = sampled("whole numbers", {17, 16, 9}, [](double x, double y, double z) {
    return std::round(1000 * gyroid()(x, y, z)) + 1024;
  });
  for (double isovalue : {1024.5, 1024.001, 1024.999, 1023.25, -0.5})
    expectSourcesSurface(field, isovalue);
}

TEST(Lossless, holdsForHugeAndTinyValues) {
  for (double scale : {1e-38, 1e-30, 1e-7, 1e7, 1e30, 1e38}) {
    for (auto field : fieldsOf({17, 16, 9})) {
      for (float& s : field.samples) s = static_cast<float>(s * scale / 200);
      expectSourcesSurface(field);
    }
  }
}

TEST(Lossless, holdsForAnOffsetThatLeavesFewBits) {
  for (auto field : fieldsOf({17, 16, 9})) {
    for (float& s : field.samples) s += 1e5F;
    expectSourcesSurface(field, 1e5);
  }
}

}  // namespace
}  // namespace isostar
