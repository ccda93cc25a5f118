// A field that ends inside the box (§2): the surface ends there, too, and nowhere else.
#include <set>

#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

constexpr Size kSize{34, 30, 37};
constexpr Point kSlanted{
    0.6, 0.48, 0.64};  // a unit vector that is no multiple of any of the grid's directions

Field slanted(double limit) {
  return halfSpace(kSlanted, limit);
}
/// The slanted plane through the middle of the ball is about at this limit.
double throughTheMiddle() {
  return 0.5 * ((kSize[0] - 1) * kSlanted[0] + (kSize[1] - 1) * kSlanted[1] +
                (kSize[2] - 1) * kSlanted[2]);
}
Field twoPieces() {
  const Field plane = slanted(throughTheMiddle());
  return [=](double x, double y, double z) { return std::abs(plane(x, y, z)) - 2.3; };
}
SampledField ball(const Field& domain) {
  return within(domain, sampled("ball", kSize, sphere(kSize)));
}
Mesh gridMesh(const Decoder& decoder, Polygonizer polygonizer) {
  return meshOf(decoder, {polygonizer, Frame::Grid, true});
}
double at(const Field& domain, const Point& p) {
  return domain(p[0], p[1], p[2]);
}

/// All of `mesh` lies within the domain, it ends only at the domain's boundary or at the box, and
/// no vertex of the surface without a domain that lies deeper inside than the bound is missing.
void expectToEndWith(const Field& domain, const Mesh& mesh, const Mesh& whole, double bound) {
  expectSound(mesh);
  expectClosed(mesh, kSize, [&](const Point& p) { return std::abs(at(domain, p)) <= bound; });
  std::vector<Point> points;
  for (uint32_t i = 0; i < verticesOf(mesh); ++i) {
    points.push_back(pointAt(mesh.positions, i));
    ASSERT_GE(at(domain, points.back()), -bound);
  }
  std::sort(points.begin(), points.end());
  for (uint32_t i = 0; i < verticesOf(whole); ++i) {
    const Point p = pointAt(whole.positions, i);
    if (at(domain, p) <= bound) continue;
    ASSERT_TRUE(std::binary_search(points.begin(), points.end(), p)) << testing::PrintToString(p);
  }
}

TEST(Domain, aSlantedPlaneCutsABallWithinTheBound) {
  for (const double bound : {0.3, 0.05, 0.02}) {
    for (const Polygonizer polygonizer : kPolygonizers) {
      SCOPED_TRACE(named(polygonizer) + ", " + std::to_string(bound));
      for (const Field& domain : {slanted(throughTheMiddle() + 2.71), twoPieces()}) {
        EncodeOptions options;
        options.maxError = bound;
        options.polygonizer = polygonizer;
        const SampledField field = ball(domain);
        SampledField whole = field;
        whole.domain.clear();
        const Decoder decoder = decoderOf(encoded(field, options));
        ASSERT_EQ(decoder.error(), Error::None);
        EXPECT_TRUE(decoder.info().trimmed);
        expectToEndWith(domain, gridMesh(decoder, polygonizer),
                        gridMesh(decoderOf(encoded(whole, options)), polygonizer), bound);
      }
    }
  }
}

TEST(Domain, eachPartCutsThePartOfTheSurfaceInIt) {
  const Shape cap = shapeOf(decoded(encoded(ball(slanted(throughTheMiddle() + 2.71)))));
  EXPECT_EQ(cap.components, 1);
  EXPECT_EQ(cap.euler, 1) << "a disc";
  const Shape caps = shapeOf(decoded(encoded(ball(twoPieces()))));
  EXPECT_EQ(caps.components, 2);
  EXPECT_EQ(caps.euler, 2) << "two discs";
  const Shape ring = shapeOf(decoded(encoded(ball([](double x, double y, double z) {
    return 3 - std::abs(slanted(throughTheMiddle())(x, y, z));
  }))));
  EXPECT_EQ(ring.components, 1);
  EXPECT_EQ(ring.euler, 0) << "a ring";
}

TEST(Domain, hidesASurfaceOutsideAndKeepsOneInside) {
  const Mesh nothing = decoded(encoded(ball(slanted(900))));
  EXPECT_TRUE(nothing.positions.empty() && nothing.normals.empty() && nothing.indices.empty());
  const SampledField field = ball(slanted(-900));
  SampledField plain = field;
  plain.domain.clear();
  const Bytes bytes = encoded(field), plainBytes = encoded(plain);
  EXPECT_EQ(decoded(bytes).positions, decoded(plainBytes).positions);
  EXPECT_LT(bytes.size(), plainBytes.size() + 16)
      << "a surface that the domain does not cut costs next to nothing";
}

TEST(Domain, everyPrefixIsClosedButForItsEnd) {
  const Field domain = twoPieces();
  const double bound = 0.1;
  EncodeOptions options;
  options.maxError = bound;
  const Bytes bytes = encoded(ball(domain), options);
  uint64_t ends = 0;
  std::set<std::size_t> lengths{bytes.size()};
  for (std::size_t length = 0; length < bytes.size(); length += 17) lengths.insert(length);
  for (const LayerInfo& layer : infoOf(bytes).layers)
    lengths.insert({layer.offset - 1, layer.offset, layer.offset + 1});
  lengths.erase(bytes.size() + 1);
  for (const std::size_t length : lengths) {
    SCOPED_TRACE("the first " + std::to_string(length));
    const Decoder decoder = decoderOf(std::span(bytes).first(length));
    ASSERT_EQ(decoder.error(), length < bytes.size() ? Error::Truncated : Error::None);
    if (!decoder.ready()) continue;
    if (!decoder.info().layers.empty() && decoder.info().layers.back().kind == "domain")
      ends = decoder.bytes();
    for (const Polygonizer polygonizer : kPolygonizers) {
      const Mesh mesh = gridMesh(decoder, polygonizer);
      expectSound(mesh);
      // A stream for cubes does not hold the ends of diagonals; there the domain is extrapolated,
      // correct to within a cell.
      const double allowed = polygonizer == Polygonizer::Cubes ? bound : std::sqrt(3);
      expectClosed(mesh, kSize,
                   [&](const Point& p) { return ends != 0 && std::abs(at(domain, p)) <= allowed; });
    }
  }
  EXPECT_GT(ends, 0u);
  EXPECT_LT(ends, bytes.size()) << "the surface ends before its geometry comes";
}

TEST(Domain, losslessIsWhatThePolygonizerMakesOfTheSource) {
  const Field rough = noise(5);
  const Field wild = [=](double x, double y, double z) { return 2 * rough(x, y, z); };
  for (const auto& field : fieldsOf({17, 12, 20})) {
    for (const Field& domain : {slanted(18), twoPieces(), wild}) {
      for (const Polygonizer polygonizer : kPolygonizers) {
        SCOPED_TRACE(described(field) + ", " + named(polygonizer));
        EncodeOptions options;
        options.lossless = true;
        options.polygonizer = polygonizer;
        SampledField cut = within(domain, field);
        cut.placement.spacing = {1.5, 1, 2};
        const MeshOptions how{polygonizer, Frame::Grid, true};
        const Mesh expected = sourceMesh(cut, how), mesh = decoded(encoded(cut, options), how);
        expectSound(mesh);
        ASSERT_EQ(mesh.indices, expected.indices);
        ASSERT_EQ(mesh.positions.size(), expected.positions.size());
        // Vertices differ by rounding to single precision; where the domain is irregular, its ends
        // differ by more.
        EXPECT_LE(furthest(mesh, expected, cut.placement), 1e-3);
      }
    }
  }
}

/// No edge has more than two triangles, and around each vertex they make one fan.
TEST(Domain, aManifoldStaysAManifoldInAnyDomain) {
  const Field rough = noise(9);
  const SampledField field = within([=](double x, double y, double z) { return rough(x, y, z); },
                                    sampled("gyroid", kSize, gyroid()));
  for (const Polygonizer polygonizer : kPolygonizers) {
    const Mesh mesh = decoded(encoded(field), {polygonizer, Frame::Grid, true});
    std::vector<std::map<uint32_t, uint32_t>> next(
        verticesOf(mesh));  // around a vertex, from neighbour to neighbour
    for (std::size_t t = 0; t < mesh.indices.size(); ++t) {
      const std::size_t first = t / 3 * 3;
      const uint32_t b = mesh.indices[first + (t + 1) % 3], c = mesh.indices[first + (t + 2) % 3];
      ASSERT_TRUE(next[mesh.indices[t]].emplace(b, c).second);
    }
    for (const auto& fan : next) {
      ASSERT_FALSE(fan.empty()) << "each vertex has a triangle";
      auto start = fan.begin();
      for (auto at = fan.begin(); at != fan.end(); ++at) {
        if (std::none_of(fan.begin(), fan.end(),
                         [&](const auto& each) { return each.second == at->first; }))
          start = at;
      }
      std::size_t met = 0;
      for (auto at = start; at != fan.end() && met <= fan.size(); ++met) {
        at = fan.find(at->second);
        if (at == start) {
          ++met;
          break;
        }
      }
      ASSERT_EQ(met, fan.size());
    }
  }
}

TEST(Domain, isStatedInTheHeaderAndCodedAsALayer) {
  const SampledField field = ball(twoPieces());
  StreamInfo info;
  ASSERT_EQ(inspect(encoded(field), info), Error::None);
  EXPECT_TRUE(info.trimmed);
  EXPECT_EQ(std::count_if(info.layers.begin(), info.layers.end(),
                          [](const LayerInfo& layer) { return layer.kind == "domain"; }),
            1);
  EncodeOptions adaptive;
  adaptive.adaptive = true;
  EXPECT_EQ(encoded(field, adaptive), encoded(field)) << "makes no difference";
}

TEST(Domain, invalidDomainsAreRefused) {
  const SampledField good = ball(twoPieces());
  const auto expectRefused = [](const SampledField& field, const EncodeOptions& options) {
    Bytes bytes;
    EXPECT_EQ(encode(field.volume(), options, bytes), Error::BadArgument);
    EXPECT_TRUE(bytes.empty());
  };
  Mesh mesh;
  for (const float strange : {NAN, INFINITY}) {
    SampledField bad = good;
    bad.domain[77] = strange;
    expectRefused(bad, {});
    EXPECT_EQ(polygonize(bad.volume(), 0, {}, mesh), Error::BadArgument);
  }
  SampledField shorter = good;
  shorter.domain.pop_back();
  expectRefused(shorter, {});
  EXPECT_EQ(polygonize(shorter.volume(), 0, {}, mesh), Error::BadArgument);
  EncodeOptions options;
  options.furtherIsovalues = {0.5};
  expectRefused(good, options);
  options.furtherIsovalues.clear();
  options.preserveTopology = true;
  expectRefused(good, options);
}

TEST(Domain, limitsHoldForTrimmedSurfaces) {
  const Field rough = noise(9);
  const Bytes bytes =
      encoded(ball([=](double x, double y, double z) { return rough(x, y, z) + 0.5; }));
  const uint64_t vertices = verticesOf(decoded(bytes)), whole = decoderOf(bytes).info().vertices;
  ASSERT_GT(vertices, whole) << "trimming adds more vertices than it removes";
  Mesh mesh;
  EXPECT_EQ(decoderOf(bytes, {1u << 30, vertices, 1u << 30}).mesh({}, mesh), Error::None);
  EXPECT_EQ(decoderOf(bytes, {1u << 30, vertices - 1, 1u << 30}).mesh({}, mesh), Error::OverLimit);
}

}  // namespace
}  // namespace isostar
