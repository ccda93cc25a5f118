#include "measure/mesh_topology.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace isostar::native {
namespace {

using measure::Topology;
using measure::topologyOf;

void expect(const Topology& found, uint64_t components, int64_t euler, std::optional<int64_t> genus,
            uint64_t boundaryEdges) {
  EXPECT_EQ(found.components, components);
  EXPECT_EQ(found.euler(), euler);
  EXPECT_EQ(found.genus(), genus);
  EXPECT_EQ(found.boundaryEdges, boundaryEdges);
}

TEST(Topology, ofASphere) {
  expect(topologyOf(sphere(10, 1)), 1, 2, 0, 0);
}

TEST(Topology, ofATorus) {
  expect(topologyOf(torus(12, 3, 1)), 1, 0, 1, 0);
}

TEST(Topology, ofTwoCubes) {
  expect(topologyOf(together(cube(0, 0, 0, 1), cube(5, 0, 0, 1))), 2, 4, 0, 0);
}

TEST(Topology, ofAPlane) {
  const Topology found = topologyOf(plane(5, 1, 0));
  expect(found, 1, 1, 0, 20);
  EXPECT_EQ(found.boundaryLoops, 1u);
}

TEST(Topology, ofATorusWithAHole) {
  Mesh mesh = torus(12, 3, 1);
  mesh.indices.resize(mesh.indices.size() - 3);
  expect(topologyOf(mesh), 1, -1, 1, 3);
}

TEST(Topology, ofNothing) {
  expect(topologyOf({}), 0, 0, 0, 0);
}

TEST(Topology, passesOverLooseVerticesAndFlatTriangles) {
  Mesh mesh = cube(0, 0, 0, 1);
  addVertex(mesh, 9, 9, 9);
  mesh.indices.insert(mesh.indices.end(), {0, 1, 1});
  expect(topologyOf(mesh), 1, 2, 0, 0);
}

TEST(Topology, seesEdgesOfThreeTriangles) {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) addVertex(mesh, i, i * i, i % 2);
  mesh.indices = {0, 1, 2, 1, 0, 3, 0, 1, 4};
  const Topology found = topologyOf(mesh);
  EXPECT_EQ(found.nonManifoldEdges, 1u);
  EXPECT_FALSE(found.genus());
}

TEST(Topology, seesTurnedTriangles) {
  Mesh mesh = cube(0, 0, 0, 1);
  std::swap(mesh.indices[0], mesh.indices[1]);
  const Topology found = topologyOf(mesh);
  EXPECT_EQ(found.misorientedEdges, 3u);
  EXPECT_FALSE(found.genus());
}

}  // namespace
}  // namespace isostar::native
