// The coders that Figure 6 is compared with: what they write, their decoders read back.
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "../property/sampled_field.h"
#include "bench/figure6/octree_codec.h"
#include "bench/figure6/octree_displacement_coder.h"
#include "bench/figure6/octree_sides.h"
#include "bench/figure6/octree_signs.h"
#include "bench/figure6/scalar_coder.h"
#include "bench/figure6/single_rate_codec.h"
#include "bench/figure6/volume_signs.h"
#include "bisection/adaptation.h"
#include "coding/adaptive/gate_traversal.h"
#include "measure/surface_distance.h"

namespace isostar::bench {
namespace {

const std::vector<Size> kFlatSizes{{1, 7, 5}, {6, 1, 9}, {9, 8, 1}, {1, 1, 12}, {1, 1, 1}};

Mesh surfaceOf(const Volume& volume) {
  Mesh mesh;
  EXPECT_EQ(polygonize(volume, 0, {Polygonizer::Cubes, Frame::Grid, false}, mesh), Error::None);
  return mesh;
}

std::vector<SampledField> shapes() {
  std::vector<SampledField> all;
  for (const Size& size : kSizes) {
    for (auto& field : fieldsOf(size)) all.push_back(std::move(field));
  }
  return all;
}

TEST(OctreeSigns, areTheSourcesOnEachLevel) {
  for (const SampledField& field : shapes()) {
    SCOPED_TRACE(described(field));
    const auto actual = signsOf(field.volume(), 0);
    const int levels = finestLevelOf(field.size);
    const OctreeEncoderSide mixed(actual, levels);
    const auto coded = std::make_unique<OctreeSigns>(lastSample(field.size), levels),
               decoded = std::make_unique<OctreeSigns>(lastSample(field.size), levels);
    for (int level = 0; level <= levels; ++level) {
      std::vector<std::byte> bytes;
      RangeEncoder out(bytes);
      coded->code(out, mixed, level);
      out.finish();
      RangeDecoder in(bytes);
      decoded->code(in, OctreeDecoderSide(), level);
      const auto grid = decoded->lattice(level);
      int wrong = 0;
      for (Coordinates<3> v{}; v[2] <= grid.last[2]; ++v[2]) {
        for (v[1] = 0; v[1] <= grid.last[1]; ++v[1]) {
          for (v[0] = 0; v[0] <= grid.last[0]; ++v[0])
            wrong += decoded->positive(grid, v) !=
                     actual.at({grid.sample(0, v[0]), grid.sample(1, v[1]), grid.sample(2, v[2])});
        }
      }
      EXPECT_EQ(wrong, 0) << "level " << level;
    }
  }
}

TEST(OctreeDisplacementCoder, comesNearerByHalfAPlane) {
  const auto field = sampled("gyroid", {17, 16, 33}, gyroid());
  const auto signs = signsOf(field.volume(), 0);
  const DualSurface surface(Lattice<3>(lastSample(field.size), 1), {1, 1, 1},
                            [&](const Coordinates<3>& v) { return signs.at(v); });
  std::mt19937 dice(1);
  std::vector<double> actual(surface.vertices());
  for (double& d : actual) d = std::normal_distribution<>(0, 0.2)(dice);
  OctreeDisplacementCoder coded(surface), decoded(surface);
  for (int plane = 0; plane < 6; ++plane) {
    std::vector<std::byte> bytes;
    RangeEncoder out(bytes);
    coded.code(
        out, plane, [&](size_t v) { return actual[v]; }, [] { return false; });
    out.finish();
    RangeDecoder in(bytes);
    decoded.code(
        in, plane, [](size_t) { return 0.0; }, [] { return false; });
    EXPECT_EQ(coded.values(), decoded.values());
    for (size_t v = 0; v < actual.size(); ++v) {
      if (std::abs(actual[v]) < 1) {
        EXPECT_LE(std::abs(decoded.values()[v] - actual[v]),
                  OctreeDisplacementCoder::stepOf(plane));
      }
    }
  }
}

TEST(ScalarCoder, tellsTheScalarsOfTheTubeWithinHalfAStep) {
  constexpr double kStep = 0.3;
  for (const SampledField& field : shapes()) {
    SCOPED_TRACE(described(field));
    const Hierarchy<3> hierarchy(lastSample(field.size), finestLevelOf(field.size));
    const auto signs = signsOf(field.volume(), 0);
    Rbmt<3> mesh(hierarchy);
    unsigned turn = 0;
    refine(mesh, [&](const auto& s) { return !mayCross(signs, hierarchy, s) || ++turn % 7 == 0; });
    const auto actual = [&](const Coordinates<3>& v) {
      return double{
          field.samples[static_cast<size_t>((v[2] * field.size[1] + v[1]) * field.size[0] + v[0])]};
    };
    std::vector<std::byte> bytes;
    const auto run = [&](auto& exchange, ScalarCoder& scalars) {
      GateTraversal<3> traversal(hierarchy);
      traversal.code(exchange, [&](const auto& leaf, const auto* from, int newVertex) {
        scalars.code(
            exchange.coder(), leaf, from, newVertex,
            [&](const auto& v) { return traversal.positive(v); }, actual);
      });
    };
    ScalarCoder coded(hierarchy, kStep), decoded(hierarchy, kStep);
    RangeEncoder out(bytes);
    MeshEncoderSide<3, RangeEncoder> unbiased(out, mesh, signs);
    run(unbiased, coded);
    out.finish();
    RangeDecoder in(bytes);
    MeshDecoderSide<3> blind(in, 8);
    run(blind, decoded);
    forEachCrossingLeaf(mesh, signs, [&](const TaggedSimplex<3>& leaf) {
      for (const auto& vertex : leaf.vertices) {
        const auto v = hierarchy.position(vertex);
        EXPECT_EQ(coded.value(v), decoded.value(v));
        EXPECT_LE(std::abs(decoded.value(v) - actual(v)), kStep / 2 + 1e-5);
      }
    });
  }
}

TEST(SingleRate, decodesNearTheSource) {
  for (const Size& size : {Size{33, 30, 35}, Size{20, 40, 17}}) {
    for (const auto& field :
         {sampled("sphere", size, sphere(size)), sampled("torus", size, torus(size)),
          sampled("plane", size, plane())}) {
      SCOPED_TRACE(described(field));
      const Mesh source = surfaceOf(field.volume());
      const std::vector<double> bounds{0.5, 0.1};
      size_t before = SIZE_MAX;
      for (double bound : bounds) {
        const auto stream =
            encodeSingleRate(field.volume(), 0, measure::TriangleTree(source), {&bound, 1})[0]
                .bytes;
        const SampledFunction decoded = decodeSingleRate(stream);
        ASSERT_EQ(decoded.size, field.size);
        const auto distance = measure::surfaceDistance(source, surfaceOf(decoded));
        ASSERT_TRUE(distance);
        EXPECT_LE(distance->symmetric().rms, bound);
        EXPECT_NE(stream.size(), before);
        before = stream.size();
      }
    }
  }
}

TEST(Octree, decodesNearerWithEachLayer) {
  for (const Size& size : {Size{33, 30, 35}, Size{20, 40, 17}}) {
    for (const auto& field :
         {sampled("sphere", size, sphere(size)), sampled("torus", size, torus(size)),
          sampled("plane", size, plane())}) {
      SCOPED_TRACE(described(field));
      const Mesh source = surfaceOf(field.volume());
      const auto stream = encodeOctree(field.volume(), 0, measure::TriangleTree(source));
      const auto layers = octreeLayers(stream);
      ASSERT_EQ(layers.back().end, stream.size());
      const measure::Measurable reference(source);
      double before = INFINITY;
      for (const auto& [end, signs] : layers) {
        const Mesh mesh = decodeOctree(std::span(stream).first(end), {1, 1, 1});
        if (mesh.indices.empty()) continue;  // nothing to be seen yet
        const double rms =
            measure::surfaceDistance(measure::Measurable(mesh), reference, 1000).symmetric().rms;
        EXPECT_LT(rms, 1.05 * before);
        before = rms;
      }
      EXPECT_LT(before, 0.05);
      for (size_t bytes = 0; bytes < stream.size(); bytes += 1 + stream.size() / 50)
        EXPECT_LE(decodeOctree(std::span(stream).first(bytes), {1, 1, 1}).indices.size(),
                  6 * source.indices.size());
    }
  }
}

TEST(Comparison, emptySurfacesAreValidStreams) {
  for (const Size& size : {Size{9, 9, 9}, Size{5, 7, 3}, Size{40, 3, 2}}) {
    for (double value : {-1.0, 1.0}) {
      const auto field = sampled("empty", size, [=](double, double, double) { return value; });
      const Mesh none;
      const double bound = 0.1;
      const auto single =
          encodeSingleRate(field.volume(), 0, measure::TriangleTree(none), {&bound, 1})[0].bytes;
      const SampledFunction decoded = decodeSingleRate(single);
      ASSERT_EQ(decoded.samples.size(), field.samples.size());
      for (float sample : decoded.samples) EXPECT_EQ(sample > 0, value > 0);
      const auto octree = encodeOctree(field.volume(), 0, measure::TriangleTree(none));
      EXPECT_TRUE(decodeOctree(octree, {1, 1, 1}).indices.empty());
    }
  }
}

TEST(Comparison, gridsWithoutExtentHaveNoSurface) {
  for (const Size& size : kFlatSizes) {
    for (const auto& field : fieldsOf(size)) {
      SCOPED_TRACE(described(field));
      const Mesh none;
      const double bound = 0.1;
      const auto single =
          encodeSingleRate(field.volume(), 0, measure::TriangleTree(none), {&bound, 1})[0].bytes;
      EXPECT_EQ(decodeSingleRate(single).samples.size(), field.samples.size());
      const auto octree = encodeOctree(field.volume(), 0, measure::TriangleTree(none));
      EXPECT_TRUE(decodeOctree(octree, {1, 1, 1}).indices.empty());
    }
  }
}

}  // namespace
}  // namespace isostar::bench
