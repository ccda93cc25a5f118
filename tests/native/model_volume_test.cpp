// Closed meshes as distance fields: what comes back from the samples is the model.
#include "model/model_volume.h"

#include <gtest/gtest.h>

#include "files/failure.h"
#include "measure/mesh_topology.h"
#include "measure/surface_distance.h"
#include "model/distance_field.h"
#include "shapes.h"

namespace isostar::native {
namespace {

LoadedVolume sampled(const Mesh& mesh, int grid = 65) {
  return modelVolume(mesh, "model", grid, [](double) {});
}

Mesh surfaceOf(const LoadedVolume& volume) {
  Mesh surface;
  EXPECT_EQ(polygonize(volume.view(), 0, {.normals = false}, surface), Error::None);
  return surface;
}

/// How far the surface of the samples and the model are apart, in steps of the grid.
measure::Distance distanceBetween(const LoadedVolume& volume, const Mesh& model) {
  measure::Distance distance = measure::surfaceDistance(surfaceOf(volume), model)->symmetric();
  for (double* each : {&distance.mean, &distance.rms, &distance.max})
    *each /= volume.placement.spacing[0];
  return distance;
}

std::string remarksOf(const LoadedVolume& volume) {
  std::string words;
  for (const std::string& remark : volume.remarks) words += remark + "\n";
  return words;
}

std::string complaint(const Mesh& mesh, int grid = 65) {
  try {
    sampled(mesh, grid);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return {};
}

Mesh knot() {
  const auto centre = [](double a) {
    return measure::Vector3{std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a),
                            -std::sin(3 * a)};
  };
  return sheet(200, 30, true, true, [&](Mesh& mesh, double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
    const measure::Vector3 along = centre(a + 1e-4) - centre(a - 1e-4);
    measure::Vector3 side = cross(along, {0, 0, 1});
    side = (1 / std::sqrt(squared(side))) * side;
    measure::Vector3 up = cross(side, along);
    up = (1 / std::sqrt(squared(up))) * up;
    const measure::Vector3 p = centre(a) + 0.35 * std::cos(b) * side + 0.35 * std::sin(b) * up;
    addVertex(mesh, p.x, p.y, p.z);
  });
}

Mesh plate(float thickness) {
  Mesh mesh = cube(0, 0, 0, 1);
  for (size_t v = 0; v < 8; ++v) mesh.positions[3 * v + 2] *= thickness;
  return mesh;
}

Mesh turned(Mesh mesh) {
  for (size_t v = 0; v < mesh.positions.size(); v += 3) {
    const float x = mesh.positions[v], y = mesh.positions[v + 1], z = mesh.positions[v + 2];
    mesh.positions[v] = 0.8f * x - 0.6f * z;
    mesh.positions[v + 2] = 0.6f * x + 0.8f * z;
    mesh.positions[v + 1] = y + 0.3f * z;
  }
  return mesh;
}

/// Every triangle with vertices of its own.
Mesh soup(const Mesh& mesh) {
  Mesh apart;
  for (uint32_t vertex : mesh.indices) {
    apart.indices.push_back(static_cast<uint32_t>(apart.indices.size()));
    for (size_t axis = 0; axis < 3; ++axis)
      apart.positions.push_back(mesh.positions[3 * size_t{vertex} + axis]);
  }
  return apart;
}

TEST(ModelVolume, tellsDistancesInStepsOfTheGrid) {
  const LoadedVolume volume = sampled(cube(-1, 2, 5, 7), 64);  // 57 steps inside the margins of 3.5
  EXPECT_EQ(volume.size, (std::array<int32_t, 3>{64, 64, 64}));
  const auto at = [&](int i, int j, int k) {
    return volume.samples[(size_t(k) * 64 + size_t(j)) * 64 + size_t(i)];
  };
  EXPECT_NEAR(at(3, 30, 30), -0.5, 1e-4);
  EXPECT_NEAR(at(4, 30, 30), 0.5, 1e-4);
  EXPECT_NEAR(at(6, 30, 5), 1.5, 1e-4);
  EXPECT_NEAR(at(3, 30, 3), -std::sqrt(0.5), 1e-4);
  EXPECT_EQ(at(32, 32, 32), kBand);
  EXPECT_NEAR(at(0, 0, 0), -kBand, 1e-4);
  EXPECT_TRUE(volume.remarks.empty()) << remarksOf(volume);
}

TEST(ModelVolume, liesWhereTheModelLies) {
  Mesh model = sphere(40, 3);
  for (size_t v = 0; v < model.positions.size(); v += 3) model.positions[v] += 1000;
  EXPECT_LT(distanceBetween(sampled(model), model).max, 0.1);
}

TEST(ModelVolume, givesBackSmoothModelsWithTheirTopology) {
  for (const Mesh& model :
       {sphere(60, 1), torus(90, 3, 1), knot(), together(sphere(60, 3), sphere(30, 1.5))}) {
    const LoadedVolume volume = sampled(model, 129);
    const measure::Distance distance = distanceBetween(volume, model);
    EXPECT_LT(distance.rms, 0.05);
    EXPECT_LT(distance.max, 0.3);
    const measure::Topology found = measure::topologyOf(surfaceOf(volume)),
                            asked = measure::topologyOf(model);
    EXPECT_EQ(found.components, asked.components);
    EXPECT_EQ(found.genus(), asked.genus());
    EXPECT_EQ(found.boundaryEdges, 0u);
    EXPECT_TRUE(volume.remarks.empty()) << remarksOf(volume);
  }
}

TEST(ModelVolume, keepsThinPlatesAndTellsOfThoseTooThin) {
  const Mesh thin = turned(plate(0.04f));  // some three steps
  const LoadedVolume kept = sampled(thin, 97);
  EXPECT_LT(distanceBetween(kept, thin).rms, 0.2);
  EXPECT_TRUE(kept.remarks.empty()) << remarksOf(kept);
  EXPECT_NE(remarksOf(sampled(plate(0.002f), 65)).find("too thin for --grid 65"),
            std::string::npos);
}

TEST(ModelVolume, neitherOrientationNorSharedVerticesMatter) {
  const Mesh model = torus(40, 3, 1);
  const std::vector<float> samples = sampled(model).samples;
  Mesh flipped = model;
  for (size_t t = 0; t < flipped.indices.size(); t += 9)
    std::swap(flipped.indices[t], flipped.indices[t + 1]);
  EXPECT_EQ(sampled(flipped).samples, samples);
  const LoadedVolume apart = sampled(soup(model));
  EXPECT_EQ(apart.samples, samples);
  EXPECT_TRUE(apart.remarks.empty()) << remarksOf(apart);
}

TEST(ModelVolume, survivesDoubledAndDegenerateTriangles) {
  Mesh model = torus(40, 3, 1);
  const std::vector<float> samples = sampled(model).samples;
  for (int i = 0; i < 6; ++i) model.indices.push_back(model.indices[static_cast<size_t>(i)]);
  model.indices.insert(model.indices.end(), {7, 7, 9});
  const LoadedVolume volume = sampled(model);
  EXPECT_EQ(volume.samples, samples);
  EXPECT_NE(
      remarksOf(volume).find("1 triangle without area left out, 2 doubled triangles left out"),
      std::string::npos);
}

TEST(ModelVolume, closesHolesByVote) {
  const Mesh whole = torus(60, 3, 1);
  Mesh open = whole;
  open.indices.erase(open.indices.begin() + 300, open.indices.begin() + 300 + 3 * 12);
  const LoadedVolume volume = sampled(open);
  EXPECT_NE(remarksOf(volume).find("not closed: 14 boundary edges"), std::string::npos)
      << remarksOf(volume);
  EXPECT_LT(distanceBetween(volume, whole).rms, 0.2);
  EXPECT_EQ(measure::topologyOf(surfaceOf(volume)).boundaryEdges, 0u);
}

TEST(ModelVolume, keepsAllOfASurfaceThatMeetsItself) {
  Mesh other = sphere(40, 1);
  for (size_t v = 0; v < other.positions.size(); v += 3) other.positions[v] += 1.2f;
  const Mesh model = together(sphere(40, 1), other);
  EXPECT_LT(distanceBetween(sampled(model, 97), model).rms, 0.1);
}

TEST(ModelVolume, refusesMeshesWithoutASurface) {
  EXPECT_EQ(complaint({}), "model: has no triangles");
  Mesh flat = cube(0, 0, 0, 1);
  flat.indices = {0, 0, 1, 2, 3, 3};
  EXPECT_EQ(complaint(flat), "model: has no triangle with an area");
  EXPECT_NE(complaint(cube(0, 0, 0, 1), 2048).find("at most 2^31"), std::string::npos);
}

}  // namespace
}  // namespace isostar::native
