// The bound: every vertex of the decoded surface lies within maxError of the source's, and the
// reverse.
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

/// Surfaces of the same signs have the same triangles over vertices with the same numbers: if each
/// pair of vertices is within the bound, so are the surfaces, in both directions.
void expectBound(const SampledField& field, double maxError, Polygonizer polygonizer) {
  SCOPED_TRACE(described(field) + ", " + named(polygonizer) + ", " + std::to_string(maxError));
  EncodeOptions options;
  options.maxError = maxError;
  options.polygonizer = polygonizer;
  const MeshOptions grid{polygonizer, Frame::Grid, true};
  const Mesh source = sourceMesh(field, grid), mesh = decoded(encoded(field, options), grid);
  expectSound(mesh);
  ASSERT_EQ(mesh.indices, source.indices);
  ASSERT_EQ(mesh.positions.size(), source.positions.size());
  // Streams state how far a crossing may move in 1/65536 of an edge.
  EXPECT_LE(furthest(mesh, source, field.placement), maxError + 2e-5);
}

TEST(Bound, isKeptByEachField) {
  for (const Size& size : {Size{2, 2, 2}, Size{5, 7, 3}, Size{17, 16, 33}}) {
    for (const auto& field : fieldsOf(size)) {
      for (double maxError : {0.3, 0.05, 0.01}) {
        for (const Polygonizer polygonizer : kPolygonizers)
          expectBound(field, maxError, polygonizer);
      }
    }
  }
}

TEST(Bound, isKeptWhenVeryLargeOrSmall) {
  for (const auto& field : fieldsOf({12, 12, 12})) {
    for (double maxError : {1e-300, 1e-40, 1e-12, 1e-5, 0.001, 1.0, 100.0, 1e300}) {
      for (const Polygonizer polygonizer : kPolygonizers) expectBound(field, maxError, polygonizer);
    }
  }
}

TEST(Bound, countsStepsAlongTheSmallestSpacing) {
  for (auto field : fieldsOf({16, 15, 14})) {
    field.placement.spacing = {0.5, 1, 3};
    for (const Polygonizer polygonizer : kPolygonizers) expectBound(field, 0.05, polygonizer);
  }
}

TEST(Bound, holdsWhereValuesSpanManyScales) {
  const Field ball = sphere({16, 16, 16}), rough = noise(5);
  const auto field = sampled("scales", {16, 16, 16}, [=](double x, double y, double z) {
    return std::copysign(std::exp(6 * rough(x, y, z)), ball(x, y, z));
  });
  for (const Polygonizer polygonizer : kPolygonizers) expectBound(field, 0.05, polygonizer);
}

TEST(Bound, holdsBesideASpike) {
  // Scalars near the isovalue next to very large ones: how far a crossing moves to first order says
  // little about how far it may move.
  for (const float spike : {300.0F, 65535.0F, 5e7F}) {
    for (const float shoulder : {1.0F, 20.0F, 16834.0F}) {
      SampledField field{"spike", {2, 7, 8}, std::vector<float>(2 * 7 * 8)};
      field.samples[0] = field.samples[1] = spike;
      field.samples[2] = shoulder;
      for (float& s : field.samples) s -= 0.5F;
      for (double maxError : {0.365, 0.05}) {
        for (const Polygonizer polygonizer : kPolygonizers)
          expectBound(field, maxError, polygonizer);
      }
    }
  }
}

TEST(Bound, aCoarserOneTakesFewerBytes) {
  const auto field = sampled("gyroid", {32, 32, 32}, gyroid());
  std::size_t before = 0;
  for (double maxError : {0.5, 0.2, 0.05, 0.01, 0.001}) {
    EncodeOptions options;
    options.maxError = maxError;
    const std::size_t size = encoded(field, options).size();
    EXPECT_GE(size, before);
    before = size;
  }
}

}  // namespace
}  // namespace isostar
