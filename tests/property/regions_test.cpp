// Regions of streams in chunks: the vertices of the whole, and fewer bytes.
#include <random>
#include <set>

#include "hostile/parts.h"
#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

const MeshOptions kInGrid{Polygonizer::Cubes, Frame::Grid, false};

std::vector<SampledField> fieldsWithDetail() {
  std::vector<SampledField> fields;
  const Size size{65, 49, 65};
  fields.push_back(sampled("gyroid", size, gyroid(21)));
  fields.push_back(sampled("sphere", size, sphere(size, 0.45)));
  return fields;
}

Bytes inChunks(const SampledField& field, EncodeOptions options = {}) {
  options.chunkSide = 16;
  return encoded(field, options);
}

/// Boxes of all sizes, some partly or wholly outside of the volume.
std::vector<Region> boxes(const Size& size) {
  std::vector<Region> result;
  std::mt19937 random(5);
  for (int i = 0; i < 6; ++i) {
    Region region;
    region.frame = Frame::Grid;
    for (std::size_t a = 0; a < 3; ++a) {
      const double from = static_cast<double>(random() % 1400) / 1000 - 0.2;
      region.least[a] = std::round(from * size[a] * 4) / 4;
      region.most[a] = region.least[a] + static_cast<double>(random() % 200) / 4;
    }
    result.push_back(region);
  }
  result.push_back({{0, 0, 0}, {31, 31, 31}, Frame::Grid});
  result.push_back({{0, 0, 0}, {1000, 1000, 1000}, Frame::Grid});
  result.push_back({{500, 0, 0}, {1000, 10, 10}, Frame::Grid});
  return result;
}

std::set<Point> verticesWithin(const Mesh& mesh, const Region& region) {
  std::set<Point> points;
  for (uint32_t i = 0; i < verticesOf(mesh); ++i) {
    const Point p = pointAt(mesh.positions, i);
    bool inside = true;
    for (std::size_t a = 0; a < 3; ++a)
      inside = inside && p[a] >= region.least[a] && p[a] <= region.most[a];
    if (inside) points.insert(p);
  }
  return points;
}

Decoder decoderOfRegion(const Region& region) {
  Decoder decoder;
  EXPECT_EQ(decoder.setRegion(region), Error::None);
  return decoder;
}

TEST(Regions, showTheVerticesOfTheWholeInClosedSurfaces) {
  for (const auto& field : fieldsWithDetail()) {
    const Bytes bytes = inChunks(field);
    ASSERT_EQ(infoOf(bytes).chunkSide, 16);
    const Mesh whole = decoded(bytes, kInGrid);
    for (const Region& region : boxes(field.size)) {
      Decoder decoder = decoderOfRegion(region);
      readWanted(bytes, decoder);
      ASSERT_EQ(decoder.error(), Error::None);
      ASSERT_TRUE(decoder.isFinal());
      const Mesh mesh = meshOf(decoder, kInGrid);
      EXPECT_EQ(verticesWithin(mesh, region), verticesWithin(whole, region))
          << testing::PrintToString(region.least) << testing::PrintToString(region.most);
      expectSound(mesh, false);
      expectClosed(mesh, field.size);
    }
  }
}

TEST(Regions, tetrahedraAndLosslessStreamsToo) {
  const auto field = fieldsWithDetail()[0];
  EncodeOptions options;
  options.lossless = true;
  options.polygonizer = Polygonizer::Tetrahedra;
  const MeshOptions shown{Polygonizer::Tetrahedra, Frame::Grid, false};
  const Bytes bytes = inChunks(field, options);
  const Mesh whole = decoded(bytes, shown);
  for (const Region& region : boxes(field.size)) {
    Decoder decoder = decoderOfRegion(region);
    readWanted(bytes, decoder);
    const Mesh mesh = meshOf(decoder, shown);
    EXPECT_EQ(verticesWithin(mesh, region), verticesWithin(whole, region));
    expectClosed(mesh, field.size);
  }
}

TEST(Regions, takeFewBytesAndNoOthers) {
  const Size size{129, 129, 129};
  const auto field = sampled("gyroid", size, gyroid(15));
  const Bytes bytes = inChunks(field);
  const Region eighth{{0, 0, 0}, {63, 63, 63}, Frame::Grid};
  Decoder decoder = decoderOfRegion(eighth);
  EXPECT_LT(readWanted(bytes, decoder), bytes.size() / 4);
  EXPECT_TRUE(decoder.isFinal());
  Decoder all;
  EXPECT_EQ(readWanted(bytes, all), bytes.size());
}

TEST(Regions, theWaysOfBytesDoNotMatter) {
  const auto field = fieldsWithDetail()[1];
  const Bytes bytes = inChunks(field);
  for (const Region& region : boxes(field.size)) {
    Decoder ranges = decoderOfRegion(region), whole = decoderOfRegion(region),
            pieces = decoderOfRegion(region), repeated = decoderOfRegion(region);
    readWanted(bytes, ranges);
    const Mesh mesh = meshOf(ranges, kInGrid);
    whole.accept(bytes);
    while (whole.advance()) {
    }
    readWanted(bytes, pieces, 17);
    for (const std::size_t from : {std::size_t{100}, std::size_t{0}, std::size_t{0}})
      repeated.accept(std::span(bytes).subspan(from), from);
    while (repeated.advance()) {
    }
    for (const Decoder* other : {&whole, &pieces, &repeated}) {
      EXPECT_TRUE(other->isFinal());
      EXPECT_EQ(other->bytes(), ranges.bytes());
      EXPECT_EQ(meshOf(*other, kInGrid).positions, mesh.positions);
    }
  }
}

TEST(Regions, ofStreamsWhoseIndexHasPagesReadTheirOwn) {
  const auto field = sampled("gyroid", {129, 129, 145}, gyroid(41));
  const Bytes bytes = inChunks(field);
  const Mesh whole = decoded(bytes, kInGrid);
  const auto share = [&](const Region& region) {
    Decoder ranges = decoderOfRegion(region), pushed = decoderOfRegion(region),
            pieces = decoderOfRegion(region);
    const uint64_t read = readWanted(bytes, ranges);
    EXPECT_TRUE(ranges.isFinal());
    const Mesh mesh = meshOf(ranges, kInGrid);
    EXPECT_EQ(verticesWithin(mesh, region), verticesWithin(whole, region));
    expectClosed(mesh, field.size);
    pushed.accept(bytes);
    readWanted(bytes, pieces, 999);
    for (Decoder* other : {&pushed, &pieces}) {
      while (other->advance()) {
      }
      EXPECT_TRUE(other->isFinal());
      EXPECT_EQ(meshOf(*other, kInGrid).positions, mesh.positions);
    }
    return static_cast<double>(read) / static_cast<double>(bytes.size());
  };
  EXPECT_LT(share({{100, 100, 0}, {120, 120, 20}, Frame::Grid}), 0.15);
  EXPECT_LT(share({{30, 30, 130}, {40, 100, 144}, Frame::Grid}), 0.2);
  EXPECT_LT(share({{500, 0, 0}, {600, 1, 1}, Frame::Grid}), 0.12);
  EXPECT_EQ(share({{-1, -1, -1}, {200, 200, 200}, Frame::Grid}), 1);
}

TEST(Regions, tornOnesShowClosedSurfaces) {
  const auto field = fieldsWithDetail()[0];
  const Bytes bytes = inChunks(field);
  const Region region{{20, 20, 20}, {50, 60, 40}, Frame::Grid};
  for (std::size_t length = 0; length <= bytes.size(); length += 1 + bytes.size() / 20) {
    Decoder decoder = decoderOfRegion(region);
    decoder.accept(std::span(bytes).first(length));
    decoder.finish();
    while (decoder.advance()) {
    }
    EXPECT_TRUE(decoder.error() == Error::Truncated || decoder.isFinal());
    if (!decoder.ready()) continue;
    const Mesh mesh = meshOf(decoder, {Polygonizer::Tetrahedra, Frame::Grid, true});
    expectSound(mesh);
    expectClosed(mesh, field.size);
  }
}

TEST(Regions, inTheWorldAreThoseOfTheGrid) {
  auto field = fieldsWithDetail()[0];
  field.placement = {{-7, 100, 3.5}, {0.7, 0.7, 2.5}, {0, -1, 0, 1, 0, 0, 0, 0, -1}};
  const Bytes bytes = inChunks(field);
  // Samples 16 … 47, 0 … 31, 16 … 31: world = origin + direction · (spacing ∘ index).
  const Region grid{{16, 0, 16}, {47, 31, 31}, Frame::Grid};
  const Region world{{-7 - 31 * 0.7, 100 + 16 * 0.7, 3.5 - 31 * 2.5},
                     {-7, 100 + 47 * 0.7, 3.5 - 16 * 2.5},
                     Frame::World};
  Decoder one = decoderOfRegion(grid), other = decoderOfRegion(world);
  EXPECT_EQ(readWanted(bytes, one), readWanted(bytes, other));
  EXPECT_EQ(meshOf(one, kInGrid).positions, meshOf(other, kInGrid).positions);
}

TEST(Regions, ofOtherStreamsAreTheWhole) {
  const Size size{40, 40, 40};
  const auto field = sampled("sphere", size, sphere(size));
  const Bytes bytes = encoded(field);
  Decoder decoder = decoderOfRegion({{0, 0, 0}, {1, 1, 1}, Frame::Grid});
  EXPECT_EQ(readWanted(bytes, decoder), bytes.size());
  EXPECT_EQ(meshOf(decoder).positions, decoded(bytes).positions);
}

TEST(Regions, thatAreNoBoxesOrComeTooLateAreBadArguments) {
  Decoder decoder;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(decoder.setRegion({{0, 0, 2}, {1, 1, 1}}), Error::BadArgument);
  EXPECT_EQ(decoder.setRegion({{0, 0, 0}, {1, kNan, 1}}), Error::BadArgument);
  EXPECT_EQ(decoder.setRegion({{-1e300, 0, 0}, {1e300, 1, 1}}), Error::None);
  const Bytes bytes(3);
  decoder.accept(bytes);
  EXPECT_EQ(decoder.setRegion({}), Error::BadArgument);
}

}  // namespace
}  // namespace isostar
