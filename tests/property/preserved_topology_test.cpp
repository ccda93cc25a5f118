// `--preserve-topology` (§4.3): each surface along the stream has the components and handles of the
// finest one.
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "delicate_shapes.h"
#include "encoder/topology/sign_flips.h"
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

/// A component: its Euler characteristic, and whether it has edges with a single triangle.
using Piece = std::pair<int64_t, bool>;

/// The components of a mesh, sorted.
std::vector<Piece> piecesOf(const Mesh& mesh) {
  std::vector<uint32_t> root(verticesOf(mesh));
  std::iota(root.begin(), root.end(), 0u);
  auto find = [&](uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      const uint32_t a = mesh.indices[t + i], b = mesh.indices[t + (i + 1) % 3];
      root[find(a)] = find(b);
      ++edges[std::minmax(a, b)];
    }
  }
  std::map<uint32_t, Piece> pieces;
  for (uint32_t v = 0; v < root.size(); ++v) ++pieces[find(v)].first;
  for (const auto& [edge, triangles] : edges) {
    auto& [euler, open] = pieces[find(edge.first)];
    --euler;
    open = open || triangles == 1;
  }
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) ++pieces[find(mesh.indices[t])].first;
  std::vector<Piece> sorted;
  for (const auto& [vertex, piece] : pieces) sorted.push_back(piece);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

EncodeOptions preserving(Polygonizer polygonizer = Polygonizer::Cubes) {
  EncodeOptions options;
  options.preserveTopology = true;
  options.polygonizer = polygonizer;
  return options;
}

SampledField fieldOf(const char* name, const SampledShape<3>& shape) {
  SampledField field{name, {shape.box[0] + 1, shape.box[1] + 1, shape.box[2] + 1}, {}};
  for (const double value : shape.values) field.samples.push_back(static_cast<float>(value));
  return field;
}

std::vector<SampledField> delicateFields() {
  return {fieldOf("knot", knot()), fieldOf("nested", nested()), fieldOf("touching", touching()),
          fieldOf("leaky box", leakyBox())};
}

/// Checks the surface of each layer; with both polygonizers if the stream is for `tetrahedra`,
/// whose topology the mesh itself guarantees.
void expectOneTopology(const SampledField& field, const EncodeOptions& options) {
  const Bytes bytes = encoded(field, options);
  const auto finest = piecesOf(decoded(bytes, {options.polygonizer, Frame::Grid, false}));
  EXPECT_EQ(finest, piecesOf(sourceMesh(field, {options.polygonizer, Frame::Grid, false})))
      << described(field);
  for (const LayerInfo& layer : infoOf(bytes).layers) {
    SCOPED_TRACE(field.name + ", " + layer.kind + " " + std::to_string(layer.level));
    const Decoder decoder = decoderOf(std::span(bytes).first(layer.offset));
    const Mesh mesh = meshOf(decoder, {options.polygonizer, Frame::Grid, true});
    expectSound(mesh);
    expectClosed(mesh, field.size);
    EXPECT_EQ(piecesOf(mesh), finest);
  }
}

TEST(PreservedTopology, holdsOnEachLayerOfDelicateShapes) {
  for (const auto& field : delicateFields()) {
    for (const Polygonizer polygonizer : kPolygonizers)
      expectOneTopology(field, preserving(polygonizer));
  }
}

TEST(PreservedTopology, holdsOnShapesThatTheBoxCuts) {
  for (const Size& size : {Size{17, 17, 17}, Size{20, 14, 31}, Size{9, 26, 18}}) {
    for (const auto& field : fieldsOf(size)) {
      for (const Polygonizer polygonizer : kPolygonizers)
        expectOneTopology(field, preserving(polygonizer));
    }
  }
}

TEST(PreservedTopology, isLostWithoutTheOption) {
  for (const auto& field : delicateFields()) {
    const Bytes bytes = encoded(field);
    const auto finest = piecesOf(decoded(bytes));
    bool all = true;
    for (const LayerInfo& layer : infoOf(bytes).layers)
      all = all && piecesOf(meshOf(decoderOf(std::span(bytes).first(layer.offset)))) == finest;
    EXPECT_FALSE(all) << field.name << " does not test anything";
  }
}

TEST(PreservedTopology, theFirstSurfaceIsCoarserThanTheLast) {
  const auto field = sampled("ball", {65, 65, 65}, sphere({65, 65, 65}));
  const Bytes bytes = encoded(field, preserving());
  const StreamInfo info = infoOf(bytes);
  EXPECT_TRUE(info.preservesTopology);
  EXPECT_EQ(info.layers.front().level, 0);
  EXPECT_LT(info.layers.front().offset * 5, info.bytes);
}

TEST(PreservedTopology, endsWithTheSameSurface) {
  for (const auto& field : delicateFields()) {
    EncodeOptions plain, options = preserving();
    plain.lossless = options.lossless = true;
    const Mesh expected = decoded(encoded(field, plain)), mesh = decoded(encoded(field, options));
    EXPECT_EQ(mesh.positions, expected.positions);
    EXPECT_EQ(mesh.indices, expected.indices);
  }
}

TEST(PreservedTopology, isForVolumesOnly) {
  const std::vector<float> samples{0, 1, 1, 0};
  Bytes bytes;
  EXPECT_EQ(encode(Image{samples, {2, 2}}, preserving(), bytes), Error::BadArgument);
}

TEST(PreservedTopology, combinesWithFurtherIsovalues) {
  const auto field = delicateFields().front();
  EncodeOptions options = preserving();
  options.furtherIsovalues = {0.3};
  const Mesh mesh = decoded(encoded(field, options), {.isovalue = 0.3});
  EncodeOptions plain;
  plain.furtherIsovalues = {0.3};
  EXPECT_EQ(mesh.indices, decoded(encoded(field, plain), {.isovalue = 0.3}).indices);
}

/// The answer for one vertex is compared with the change of the whole surface.
TEST(SignFlips, thatAreAllowedChangeNoComponent) {
  uint64_t state = 1;
  const auto draw = [&] {
    return (state = state * 6364136223846793005u + 1442695040888963407u) >> 33;
  };
  std::map<bool, int> counts;
  for (int i = 0; i < 400; ++i) {
    SampledField field{"noise", {4, 5, 4}, {}};
    Signs<3> signs(Lattice<3>({3, 4, 3}, 1));
    const uint64_t share = 1 + draw() % 7;
    for (int32_t z = 0; z < 4; ++z)
      for (int32_t y = 0; y < 5; ++y)
        for (int32_t x = 0; x < 4; ++x) {
          field.samples.push_back(draw() % 8 < share ? 1 : -1);
          signs.set({x, y, z}, field.samples.back() > 0);
        }
    const Coordinates<3> v{static_cast<int32_t>(draw() % 4), static_cast<int32_t>(draw() % 5),
                           static_cast<int32_t>(draw() % 4)};
    const auto before = piecesOf(sourceMesh(field, {.normals = false}));
    float& sample = field.samples[static_cast<std::size_t>(v[0] + 4 * (v[1] + 5 * v[2]))];
    sample = -sample;
    const auto after = piecesOf(sourceMesh(field, {.normals = false}));
    const bool keeps = flipKeepsTopology(signs, v);
    ++counts[keeps];
    if (keeps) {
      EXPECT_EQ(after, before);
    }
  }
  EXPECT_GT(counts[true], 20);
  EXPECT_GT(counts[false], 20);
}

}  // namespace
}  // namespace isostar
