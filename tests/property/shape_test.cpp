// The surface of every level is closed and consistently oriented, has the right genus, and its
// normals point to smaller values.
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

/// Calls visit(decoder) after each layer.
template <class Visit>
void forEachLayer(const Bytes& bytes, Visit visit) {
  Decoder decoder;
  decoder.accept(bytes);
  while (decoder.advance()) visit(decoder);
  EXPECT_TRUE(decoder.isFinal());
}

TEST(Shape, everyLevelIsClosed) {
  for (const Size& size : kSizes) {
    for (const auto& field : fieldsOf(size)) {
      forEachLayer(encoded(field), [&](const Decoder& decoder) {
        for (const Polygonizer polygonizer : kPolygonizers) {
          SCOPED_TRACE(described(field) + ", " + named(polygonizer) + ", level " +
                       std::to_string(decoder.level()));
          const Mesh mesh = meshOf(decoder, {polygonizer, Frame::Grid, true});
          expectSound(mesh);
          expectClosed(mesh, size);
        }
      });
    }
  }
}

TEST(Shape, aSphereAndATorusHaveTheirGenus) {
  const Size size{40, 40, 40};
  const std::vector<std::pair<SampledField, int64_t>> fields{
      {sampled("sphere", size, sphere(size)), 2}, {sampled("torus", size, torus(size)), 0}};
  for (const auto& [field, euler] : fields) {
    forEachLayer(
        encoded(field), [&, &name = field.name, &expected = euler](const Decoder& decoder) {
          if (decoder.level() < decoder.levels() - 2)
            return;  // on coarser levels the ring may be cut
          for (const Polygonizer polygonizer : kPolygonizers) {
            SCOPED_TRACE(name + ", " + named(polygonizer) + ", level " +
                         std::to_string(decoder.level()));
            const Shape shape = shapeOf(meshOf(decoder, {polygonizer, Frame::Grid, false}));
            EXPECT_EQ(shape.components, 1);
            EXPECT_EQ(shape.euler, expected);
          }
        });
  }
}

TEST(Shape, allOfManySmallComponentsAreFound) {
  const auto field = sampled("bubbles", {40, 40, 40}, [](double x, double y, double z) {
    return std::fmod(x, 5) == 3 && std::fmod(y, 5) == 2 && std::fmod(z, 5) == 1 ? 1.0 : -0.5;
  });
  const Shape shape = shapeOf(decoded(encoded(field)));
  EXPECT_EQ(shape.components, 512);
  EXPECT_EQ(shape.euler, 2 * 512);
}

/// Right-handed, left-handed and oblique placements, with spacings and an origin.
std::vector<Placement> placements() {
  Placement flipped, mirrored, oblique;
  flipped.spacing = {0.5, 1, 2};
  flipped.origin = {-100, 20, 3};
  flipped.direction = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  mirrored.spacing = {1, 1, 1.5};
  mirrored.direction = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
  oblique.spacing = {0.8, 1, 1.2};
  oblique.direction = {1, 0.2, 0, 0.1, 1, 0.3, 0, -0.2, 1};
  return {Placement{}, flipped, mirrored, oblique};
}

Point inWorld(const Placement& p, const Point& sample) {
  Point world;
  for (std::size_t a = 0; a < 3; ++a) {
    world[a] = p.origin[a];
    for (std::size_t b = 0; b < 3; ++b)
      world[a] += p.direction[a * 3 + b] * p.spacing[b] * sample[b];
  }
  return world;
}

TEST(Shape, normalsPointToSmallerValuesInAnyPlacement) {
  const Size size{30, 30, 30};
  for (const Placement& placement : placements()) {
    for (auto field : {sampled("sphere", size, sphere(size)), sampled("torus", size, torus(size)),
                       sampled("gyroid", size, gyroid(15))}) {
      field.placement = placement;
      for (const Polygonizer polygonizer : kPolygonizers) {
        SCOPED_TRACE(field.name + ", " + named(polygonizer) + ", direction " +
                     testing::PrintToString(placement.direction));
        EncodeOptions options;
        options.polygonizer = polygonizer;
        const Mesh mesh = decoded(encoded(field, options), {polygonizer, Frame::World, true});
        expectSound(mesh);
        expectNormalsOnTheOuterSide(mesh, 2 * options.maxError);
      }
    }
  }
}

TEST(Shape, normalsOfASpherePointAwayFromItsCentre) {
  const Size size{30, 28, 26};
  for (const Placement& placement : placements()) {
    auto field = sampled("sphere", size, sphere(size));
    field.placement = placement;
    const Point centre = inWorld(placement, {14.5, 13.5, 12.5});
    const Mesh mesh = decoded(encoded(field));
    for (uint32_t i = 0; i < verticesOf(mesh); ++i)
      EXPECT_GT(dot(minus(pointAt(mesh.positions, i), centre), pointAt(mesh.normals, i)), 0);
  }
}

TEST(Shape, worldFrameIsThePlacedGridFrame) {
  for (const Placement& placement : placements()) {
    auto field = sampled("gyroid", {12, 13, 14}, gyroid());
    field.placement = placement;
    const Bytes bytes = encoded(field);
    const Mesh grid = decoded(bytes, {Polygonizer::Cubes, Frame::Grid, true}),
               world = decoded(bytes);
    ASSERT_EQ(grid.positions.size(), world.positions.size());
    for (uint32_t i = 0; i < verticesOf(grid); ++i) {
      const Point expected = inWorld(placement, pointAt(grid.positions, i)),
                  found = pointAt(world.positions, i);
      for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(found[a], expected[a], 1e-4);
    }
  }
}

TEST(Shape, normalsAreOptional) {
  const auto field = sampled("gyroid", {12, 13, 14}, gyroid());
  const Mesh mesh = decoded(encoded(field), {Polygonizer::Cubes, Frame::World, false});
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_FALSE(mesh.positions.empty());
}

}  // namespace
}  // namespace isostar
