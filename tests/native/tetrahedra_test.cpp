// Tetrahedral meshes as fields: what is mended, where they end, their isosurface, and what of them
// a grid keeps.
#include <gtest/gtest.h>

#include <cmath>

#include "files/failure.h"
#include "measure/mesh_topology.h"
#include "measure/surface_distance.h"
#include "tetrahedra/bounded_encoding.h"
#include "tetrahedra/extended_surface.h"
#include "tetrahedra/flat_boundary.h"
#include "tetrahedra/grid_choice.h"
#include "tetrahedra/marching_tetrahedra.h"
#include "tetrahedra/mesh_repair.h"
#include "tetrahedra/resampled_field.h"
#include "tetrahedra/tetrahedra_distance.h"
#include "tetrahedra/tetrahedra_volume.h"
#include "tetrahedra/trimmed_surface.h"
#include "tetrahedral_shapes.h"

namespace isostar::native {
namespace {

using measure::Vector3;

double linear(const Vector3& p) {
  return 0.5 * p.x - 0.25 * p.y + p.z;
}

double ball(const Vector3& p) {
  return 3 - std::sqrt(squared(p - Vector3{4.1, 4.2, 3.9}));
}

TetrahedralField fieldOf(TetrahedralMesh mesh) {
  repair(mesh, "mesh");
  return TetrahedralField(std::move(mesh));
}

std::string remarksOf(const TetrahedralMesh& mesh) {
  std::string words;
  for (const std::string& remark : mesh.remarks) words += remark + "\n";
  return words;
}

std::string complaint(TetrahedralMesh mesh) {
  try {
    repair(mesh, "mesh");
  } catch (const Failure& failure) {
    return failure.what();
  }
  return {};
}

TEST(Mend, leavesASoundMeshAsItIs) {
  const TetrahedralMesh before = cubesOfTetrahedra(3, linear);
  TetrahedralMesh mesh = before;
  repair(mesh, "mesh");
  EXPECT_EQ(mesh.tetrahedra, before.tetrahedra);
  EXPECT_EQ(mesh.values, before.values);
  EXPECT_EQ(remarksOf(mesh), "");
}

TEST(Mend, countsWhatItLeavesOutAndTurns) {
  TetrahedralMesh mesh = cubesOfTetrahedra(2, linear);
  mesh.points.push_back({NAN, 0, 0});  // in no tetrahedron: nobody asks
  mesh.values.push_back(NAN);
  mesh.tetrahedra.push_back({0, 1, 2, 1});
  mesh.tetrahedra.push_back({0, 1, 2, 4});  // in one plane
  mesh.tetrahedra.push_back(mesh.tetrahedra[5]);
  std::swap(mesh.tetrahedra[7][0], mesh.tetrahedra[7][1]);
  repair(mesh, "mesh");
  EXPECT_EQ(remarksOf(mesh),
            "points of no tetrahedron, left out: 1\ntetrahedra without a volume, left out: 2\n"
            "doubled tetrahedra, left out: 1\ninverted tetrahedra, reoriented: 1\n");
  EXPECT_EQ(mesh.tetrahedra.size(), 48u);
  EXPECT_EQ(mesh.points.size(), 27u);
}

TEST(Mend, joinsPointsOfOnePlaceAndValue) {
  TetrahedralMesh apart;
  for (TetrahedralMesh whole = cubesOfTetrahedra(2, linear);
       const Corners4& corners : whole.tetrahedra) {
    const auto first = static_cast<uint32_t>(apart.points.size());
    apart.tetrahedra.push_back({first, first + 1, first + 2, first + 3});
    for (uint32_t point : corners) {
      apart.points.push_back(whole.points[point]);
      apart.values.push_back(whole.values[point]);
    }
  }
  repair(apart, "mesh");
  EXPECT_EQ(apart.points.size(), 27u);
  EXPECT_EQ(apart.tetrahedra.size(), 48u);
}

TEST(Mend, refusesWhatIsNotFiniteOrHasNoVolume) {
  TetrahedralMesh mesh = cubesOfTetrahedra(2, linear);
  mesh.values[3] = NAN;
  mesh.values[20] = INFINITY;
  EXPECT_EQ(complaint(mesh), "mesh: not finite: 2 of 27 scalars, the first at point 3");
  mesh = cubesOfTetrahedra(2, linear);
  mesh.points[4].y = NAN;
  EXPECT_EQ(complaint(mesh), "mesh: point 4 is not finite");
  mesh = cubesOfTetrahedra(2, linear);
  for (Vector3& point : mesh.points) point.z = 0;
  EXPECT_EQ(complaint(mesh), "mesh: has no tetrahedron with a volume");
}

TEST(TetrahedralField, isLinearInsideAndJustBeyond) {
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(4, linear));
  uint32_t near = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3 point{i * 37 % 101 / 25.0, i * 53 % 101 / 25.0, i * 29 % 101 / 25.0};
    const bool within = point.x <= 4 && point.y <= 4 && point.z <= 4;
    ASSERT_EQ(field.inside(point), within);
    if (within) {
      ASSERT_NEAR(*field.value(point), linear(point), 1e-5);
    }
    ASSERT_NEAR(field.beyond(point + Vector3{0, 0, 5}, 10, near), linear(point + Vector3{0, 0, 5}),
                1e-4);
  }
  EXPECT_NEAR(field.beyond({1.2, 3.1, 104}, 2, near), linear({1.2, 3.1, 6}), 1e-4)
      << "it stays as it was at its reach";
  EXPECT_NEAR(field.domainDistance({2, 1, 2.2}, near), 1, 1e-6);
  EXPECT_NEAR(field.domainDistance({2, 1, -0.5}, near), -0.5, 1e-6);
}

TEST(TetrahedralField, endsWhereNoTetrahedronFollows) {
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(3, linear));
  const measure::Topology topology = measure::topologyOf(field.boundary().mesh);
  EXPECT_EQ(topology.triangles, 6u * 9 * 2);
  EXPECT_EQ(topology.boundaryEdges + topology.misorientedEdges + topology.nonManifoldEdges, 0u);
  EXPECT_EQ(topology.components, 1u);
}

TEST(TetrahedralField, doesNotEndAtHangingNodesNorAtUnlikeValuesOfOnePlace) {
  TetrahedralMesh fine = cubesOfTetrahedra(4, linear), coarse = cubesOfTetrahedra(2, linear);
  for (Vector3& point : coarse.points) point = {4 + 2 * point.x, 2 * point.y, 2 * point.z};
  const TetrahedralField hanging = fieldOf(together(fine, coarse));
  EXPECT_EQ(hanging.boundary().hangingNodes,
            16u);  // 25 points of the fine face, 9 of the coarse one
  uint32_t near = 0;
  EXPECT_NEAR(hanging.domainDistance({4, 2.2, 1.9}, near), 1.8, 1e-5);
  EXPECT_NE(remarksOf(hanging.mesh()).find("hanging nodes: 16"), std::string::npos);

  TetrahedralMesh other = fine;
  for (Vector3& point : other.points) point.x += 4;
  for (float& value : other.values) value += 100;
  const TetrahedralField torn = fieldOf(together(fine, other));
  EXPECT_EQ(torn.boundary().hangingNodes, 0u);
  EXPECT_NEAR(torn.domainDistance({4, 2.2, 1.9}, near), 1.8, 1e-5);
}

TEST(MarchingTetrahedra, aBallIsClosedAndItsNormalsPointOut) {
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(8, ball));
  const Mesh surface = isosurfaceOf(field.mesh(), 0);
  const measure::Topology topology = measure::topologyOf(surface);
  EXPECT_EQ(topology.boundaryEdges, 0u);
  EXPECT_EQ(topology.genus(), 0);
  double volume = 0;
  for (size_t t = 0; t < surface.indices.size(); t += 3) {
    const auto at = [&](size_t c) {
      return measure::vertexAt(surface.positions, surface.indices[t + c]);
    };
    volume += dot(cross(at(0), at(1)), at(2)) / 6;
    EXPECT_NEAR(*field.value(at(0)), 0, 1e-5);
  }
  EXPECT_NEAR(volume, 4.0 / 3 * 3.14159 * 27, 8)
      << "positive where triangles are counter-clockwise from outside";
}

TEST(MarchingTetrahedra, cutsEveryKindOfTetrahedronTheRightWay) {
  for (unsigned positive = 1; positive < 15; ++positive) {
    TetrahedralMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, {{0, 1, 2, 3}}, {}};
    Vector3 towardsNegative{};
    for (unsigned i = 0; i < 4; ++i) {
      const double sign = positive >> i & 1 ? 1 : -1;
      mesh.values.push_back(static_cast<float>(sign));
      towardsNegative = towardsNegative - sign * (mesh.points[i] - Vector3{0.25, 0.25, 0.25});
    }
    const Mesh cut = isosurfaceOf(mesh, 0);
    for (size_t t = 0; t < cut.indices.size(); t += 3) {
      const auto at = [&](size_t c) {
        return measure::vertexAt(cut.positions, cut.indices[t + c]);
      };
      EXPECT_GT(dot(cross(at(1) - at(0), at(2) - at(0)), towardsNegative), 0) << positive;
    }
    EXPECT_EQ(measure::topologyOf(cut).misorientedEdges, 0u);
  }
}

TEST(Trimmed, endsAtTheDomainsBoundary) {
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(4, linear));
  Mesh wide;  // far beyond on all sides, at z = 1.5
  wide.positions = {-20, -20, 1.5, 20, -20, 1.5, 20, 20, 1.5, -20, 20, 1.5};
  wide.indices = {0, 1, 2, 0, 2, 3};
  EXPECT_TRUE(trimToDomain(wide, field).indices.empty()) << "no vertex is inside";
  Mesh grid;
  for (int j = 0; j < 17; ++j)
    for (int i = 0; i < 17; ++i)
      grid.positions.insert(grid.positions.end(), {i * 0.4f - 1, j * 0.4f - 1, 1.5f});
  for (uint32_t j = 0; j < 16; ++j)
    for (uint32_t i = 0; i < 16; ++i)
      for (uint32_t c : {0u, 1u, 18u, 0u, 18u, 17u}) grid.indices.push_back(j * 17 + i + c);
  const Mesh kept = trimToDomain(grid, field);
  float low = 9, high = -9;
  for (size_t v = 0; v < kept.positions.size(); v += 3) {
    low = std::min(low, kept.positions[v]);
    high = std::max(high, kept.positions[v]);
  }
  EXPECT_NEAR(low, 0, 1e-5);
  EXPECT_NEAR(high, 4, 1e-5);
}

TEST(Resample, keepsALinearFieldAndTellsWhereItEnds) {
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(4, linear));
  const SampleGrid grid{{-1, -1, -1}, {0.5, 0.5, 0.5}, {13, 13, 13}};
  const ResampledField sampled = resample(field, grid, [](double) {});
  for (int k = 0; k < 13; ++k)
    for (int j = 0; j < 13; ++j)
      for (int i = 0; i < 13; ++i) {
        const Vector3 p = grid.at(i, j, k);
        const size_t at = static_cast<size_t>((k * 13 + j) * 13 + i);
        const double depth = std::min({p.x, p.y, p.z, 4 - p.x, 4 - p.y, 4 - p.z});
        if (depth > -0.6) {
          ASSERT_NEAR(sampled.samples[at], linear(p), 1e-5);
        }
        if (depth >= 0) {
          ASSERT_NEAR(sampled.domain[at], std::min<double>(kDomainBand, depth / 0.5), 1e-5);
        } else {
          ASSERT_LT(sampled.domain[at], -0.99);
        }
      }
}

TEST(Resample, gridsCoverTheMesh) {
  TetrahedralMesh mesh = cubesOfTetrahedra(8, ball);
  for (Vector3& point : mesh.points) point.y *= 0.3;
  const TetrahedralField field = fieldOf(mesh);
  EXPECT_EQ(chooseGrid(field, 0, 33, "mesh").size, (std::array<int32_t, 3>{33, 11, 33}));
  EXPECT_EQ(chooseGrid(field, 0, {}, "mesh").size[0], chooseGrid(field, 99, {}, "mesh").size[0])
      << "without a surface the coarsest";
  EXPECT_THROW((void)chooseGrid(field, 0, 2048, "mesh"), Failure);
}

/// Two rooms of 4 × 4 × 4 with air of that thickness between them, linear across both.
TetrahedralField roomsApart(double thickness) {
  TetrahedralMesh rooms = cubesOfTetrahedra(4, linear), other = rooms;
  for (Vector3& point : other.points) point.x += 4 + thickness;
  for (size_t i = 0; i < other.points.size(); ++i)
    other.values[i] = static_cast<float>(linear(other.points[i]));
  return fieldOf(together(rooms, other));
}

TEST(FlatParts, areWallsAndHowMuchOfTheBoundaryTheyAre) {
  const auto parts = flatParts(roomsApart(1).boundary().mesh);
  ASSERT_EQ(parts[0].size(), 4u);
  const std::array<double, 4> walls = {0, 4, 5, 9};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(parts[0][i].coordinate, walls[i], 1e-6);
    EXPECT_NEAR(parts[0][i].share, 1.0 / 12, 1e-6);
  }
  ASSERT_EQ(parts[2].size(), 2u);
  EXPECT_NEAR(parts[2][1].share, 1.0 / 6, 1e-6);
}

TEST(GridOver, hasBoxAndWallsOnItsPlanes) {
  const TetrahedralField field = roomsApart(1);
  const SampleGrid grid = chooseGrid(field, 4, {}, "mesh");
  for (const double wall : {0.0, 4.0, 5.0, 9.0}) {
    const double plane = wall / grid.steps.x;
    EXPECT_NEAR(plane, std::round(plane), 1e-6) << wall;
  }
  EXPECT_NEAR((grid.size[0] - 1) * grid.steps.x, 9, 1e-6);
  EXPECT_NEAR((grid.size[2] - 1) * grid.steps.z, 4, 1e-6);
  EXPECT_LE(grid.steps.z, 1.0 / 2 * std::sqrt(3)) << "two steps to an edge";
}

TEST(GridOver, stepsOfAThinMeshAreNotOfAnotherScale) {
  TetrahedralMesh mesh = cubesOfTetrahedra(8, ball);
  for (Vector3& point : mesh.points) point.z *= 1e-6;
  const SampleGrid grid = chooseGrid(fieldOf(mesh), 0, 33, "mesh");
  EXPECT_EQ(grid.size[2], 2);
  EXPECT_LE(grid.steps.x / grid.steps.z, 4.0001);
}

TEST(Resample, hasNoDomainWhereThatIsTheGrid) {
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(4, linear));
  EXPECT_TRUE(resample(field, chooseGrid(field, 4, 17, "mesh"), [](double) {}).domain.empty());
}

TEST(Resample, seesAirOneStepThick) {
  const TetrahedralField field = roomsApart(1);
  const SampleGrid grid{{0, 0, 0}, {1, 1, 1}, {10, 5, 5}};
  const ResampledField sampled = resample(field, grid, [](double) {});
  Volume volume{sampled.samples, grid.size, {}, sampled.domain};
  Mesh surface;
  ASSERT_EQ(polygonize(volume, 4.1, {.normals = false}, surface), Error::None);
  EXPECT_EQ(measure::topologyOf(surface).components, 2u);
  const auto distance = measure::surfaceDistance(surface, isosurfaceOf(field.mesh(), 4.1));
  ASSERT_TRUE(distance);
  EXPECT_LT(distance->symmetric().max, 0.05);
}

TEST(Resample, theSurfaceReachesTheDomainsBoundaryAndIsNear) {
  const auto wave = [](const Vector3& p) {
    return p.z - 4.2 - std::sin(0.7 * p.x) * std::cos(0.5 * p.y);
  };
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(8, wave));
  const SampleGrid grid = chooseGrid(field, 0, 65, "mesh");
  const ResampledField sampled = resample(field, grid, [](double) {});
  Volume volume{sampled.samples, grid.size, {}};
  volume.placement.spacing = {grid.steps.x, grid.steps.y, grid.steps.z};
  Mesh surface;
  ASSERT_EQ(polygonize(volume, 0, {.normals = false}, surface), Error::None);
  const auto distance = distanceToTetrahedra(surface, field, isosurfaceOf(field.mesh(), 0));
  EXPECT_LT(distance->symmetric().max, 0.5 * grid.smallestStep());
  EXPECT_LT(distance->symmetric().rms, 0.1 * grid.smallestStep());
}

TEST(ExtendedSurface, goesOnInItsPlanes) {
  Mesh square;
  square.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  square.indices = {0, 1, 2, 0, 2, 3};
  const ExtendedSurface surface(square);
  uint32_t near = 0;
  for (const Vector3& above : {Vector3{0.5, 0.25, 0.3}, {0.5, 0.5, -0.3}, {0.2, 0.7, 0.3}}) {
    const auto distance = surface.distance(above, near);
    EXPECT_NEAR(distance.toSurface, 0.3, 1e-6);
    EXPECT_NEAR(distance.toExtension, 0.3, 1e-6);
  }
  for (const Vector3& beside : {Vector3{2, 0.5, 0.3}, {0.5, -1, 0.3}, {-1, 1, -0.3}}) {
    const auto distance = surface.distance(beside, near);
    EXPECT_NEAR(distance.toSurface, std::sqrt(1.09), 1e-6);
    EXPECT_NEAR(distance.toExtension, 0.3, 1e-6);
  }
}

TEST(BecomeDistances, keepsSignsAndBringsTheSurfaceNearer) {
  const auto steep = [](const Vector3& p) { return std::exp(2 * p.z - 0.6 * p.x + 0.3 * p.y); };
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(8, steep));
  for (const double isovalue : {900.0, 0.4}) {
    const Mesh isosurface = isosurfaceOf(field.mesh(), isovalue);
    const SampleGrid grid = chooseGrid(field, isovalue, 20, "mesh");
    const auto sampled = [&](Scalars scalars) {
      return volumeOf(field, isosurface, isovalue, scalars, grid, [](double) {});
    };
    const TetrahedraVolume before = sampled(Scalars::Field), after = sampled(Scalars::Distances);
    for (size_t i = 0; i < before.volume.samples.size(); ++i)
      ASSERT_EQ(after.volume.samples[i] > isovalue, before.volume.samples[i] > isovalue);
    EXPECT_LT(after.distance->symmetric().rms, 0.8 * before.distance->symmetric().rms);
  }
}

TEST(EncodeWithin, holdsTheBoundAgainstTheTetrahedra) {
  const TetrahedralField field = fieldOf(cubesOfTetrahedra(8, ball));
  const Mesh isosurface = isosurfaceOf(field.mesh(), 0);
  size_t before = 0, samplesBefore = 0;
  for (const double bound : {0.3, 0.06, 0.03}) {
    const BoundedStream made = encodeWithin(bound, field, {}, "mesh", [](double) {});
    Decoder decoder;
    decoder.accept(made.stream);
    while (decoder.advance()) {
    }
    Mesh surface;
    ASSERT_EQ(decoder.mesh({}, surface), Error::None);
    const auto distance = measure::surfaceDistance(surface, isosurface);
    EXPECT_LE(distance->symmetric().max, bound);
    EXPECT_NEAR(distance->symmetric().max, made.distance, 1e-6);
    EXPECT_GT(made.stream.size(), before);
    EXPECT_GE(made.volume.samples.size(), samplesBefore);
    before = made.stream.size();
    samplesBefore = made.volume.samples.size();
  }
}

TEST(EncodeWithin, anEmptySurfaceKeepsAnyBound) {
  EncodeOptions options;
  options.isovalue = 99;
  const BoundedStream made =
      encodeWithin(1e-9, fieldOf(cubesOfTetrahedra(4, ball)), options, "mesh", [](double) {});
  EXPECT_EQ(made.distance, 0);
  EXPECT_FALSE(made.stream.empty());
}

}  // namespace
}  // namespace isostar::native
