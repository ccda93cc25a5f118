// RDOQ: streams may hold scalars that differ from the source's, so that crossings lie nearer to
// their actual positions.
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

/// The RMS distance of vertices from the tangent planes at the source's vertices of the same
/// number, in grid steps.
double across(const Mesh& mesh, const Mesh& source) {
  double sum = 0;
  for (uint32_t i = 0; i < verticesOf(source); ++i) {
    const double distance = dot(minus(pointAt(mesh.positions, i), pointAt(source.positions, i)),
                                pointAt(source.normals, i));
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(verticesOf(source)));
}

/// The error of the surface of the first isovalue, and the bytes of the layers up to its last one.
struct Rate {
  double rms;
  uint64_t bytes;
};
Rate rateOf(const SampledField& field, EncodeOptions options) {
  const Bytes bytes = encoded(field, options);
  Rate rate{};
  for (const LayerInfo& layer : infoOf(bytes).layers) {
    if (layer.isovalue == 0) rate.bytes = layer.offset;
  }
  MeshOptions grid{Polygonizer::Cubes, Frame::Grid, true};
  grid.isovalue = options.isovalue;
  rate.rms = across(decoded(bytes, grid), sourceMesh(field, grid));
  return rate;
}

TEST(Rdoq, bringsSurfacesNearerForNoMoreBytes) {
  const Size size{48, 48, 48};
  const Field rough = noise(3), smooth = gyroid(17);
  for (const double roughness : {0.0, 0.1}) {
    const SampledField field = sampled("gyroid", size, [&](double x, double y, double z) {
      return smooth(x, y, z) + roughness * rough(x, y, z);
    });
    for (const int effort : {1, 2}) {
      EncodeOptions withRdoq, without;
      withRdoq.effort = without.effort = effort;
      without.furtherIsovalues = {50};  // beyond all samples; further isovalues turn RDOQ off
      const Rate with = rateOf(field, withRdoq), plain = rateOf(field, without);
      EXPECT_LT(with.rms, 0.93 * plain.rms);
      EXPECT_LT(with.bytes, plain.bytes * 101 / 100);
    }
  }
}

TEST(Rdoq, holdsTheBoundWhereScalarsAreRough) {
  for (const uint64_t seed : {1, 2, 3, 4}) {
    const Field rough = noise(seed);
    const SampledField field = sampled("rough", {30, 31, 29}, [&](double x, double y, double z) {
      return rough(x, y, z) * std::exp(3 * rough(z, x, y));
    });
    for (const double maxError : {0.14, 0.1, 0.05, 0.02, 0.003}) {
      for (const int effort : {1, 2}) {
        EncodeOptions options;
        options.maxError = maxError;
        options.effort = effort;
        const MeshOptions grid{Polygonizer::Cubes, Frame::Grid, false};
        const Mesh mesh = decoded(encoded(field, options), grid), source = sourceMesh(field, grid);
        ASSERT_EQ(mesh.indices, source.indices);
        EXPECT_LE(furthest(mesh, source, field.placement), maxError + 2e-5)
            << seed << ", " << maxError << ", " << effort;
      }
    }
  }
}

}  // namespace
}  // namespace isostar
