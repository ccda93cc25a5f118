// Several decoders that share the chunks of a stream: together they make the surface of one.
#include <algorithm>
#include <random>

#include "round_trip.h"
#include "surface_checks.h"

namespace isostar {
namespace {

/// Decoders of one stream, which give each other their results.
class Shares {
 public:
  Shares(const Bytes& bytes, int count, const std::optional<Region>& region = {}) {
    for (int i = 0; i < count; ++i) {
      decoders_.emplace_back();
      EXPECT_EQ(decoders_.back().setShare({i, count}), Error::None);
      if (region) {
        EXPECT_EQ(decoders_.back().setRegion(*region), Error::None);
      }
      decoders_.back().accept(bytes);
      decoders_.back().finish();
    }
  }

  /// Decodes one more layer; false at the end. All must agree.
  bool advance() {
    const bool any = advanceEach();
    if (!decoders_[0].needsOthers()) return any;
    EXPECT_FALSE(any);
    giveResults();
    return advanceEach();
  }
  [[nodiscard]] const Decoder& first() const { return decoders_[0]; }

  Mesh mesh(const MeshOptions& options) {
    giveResults();
    struct Run {
      MeshRun run;
      std::size_t share, vertex, corner;
    };
    std::vector<Run> runs;
    std::vector<Mesh> parts(decoders_.size());
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < decoders_.size(); ++i) {
      std::vector<MeshRun> own;
      EXPECT_EQ(decoders_[i].mesh(options, parts[i], own), Error::None);
      std::size_t vertex = 0, corner = 0;
      for (const MeshRun& run : own) {
        runs.push_back({run, i, vertex, corner});
        vertex += run.vertices;
        corner += run.corners;
      }
      EXPECT_EQ(vertex * 3, parts[i].positions.size());
      EXPECT_EQ(corner, parts[i].indices.size());
      vertices += vertex;
    }
    std::ranges::sort(runs, {}, [](const Run& run) { return run.run.order; });
    Mesh mesh;
    mesh.positions.resize(vertices * 3);
    for (const auto& [run, share, vertex, corner] : runs) {
      std::copy_n(parts[share].positions.begin() + static_cast<std::ptrdiff_t>(vertex * 3),
                  run.vertices * 3, mesh.positions.begin() + run.firstVertex * 3);
      const auto corners = parts[share].indices.begin() + static_cast<std::ptrdiff_t>(corner);
      mesh.indices.insert(mesh.indices.end(), corners, corners + run.corners);
    }
    return mesh;
  }

 private:
  bool advanceEach() {
    const bool result = decoders_[0].advance();
    for (std::size_t i = 1; i < decoders_.size(); ++i) EXPECT_EQ(decoders_[i].advance(), result);
    for (const Decoder& decoder : decoders_) {
      EXPECT_EQ(decoder.needsOthers(), decoders_[0].needsOthers());
      EXPECT_EQ(decoder.bytes(), decoders_[0].bytes());
      EXPECT_EQ(decoder.error(), decoders_[0].error());
    }
    return result;
  }
  void giveResults() {
    std::vector<Bytes> results;
    for (const Decoder& decoder : decoders_) results.push_back(decoder.results());
    for (std::size_t to = 0; to < decoders_.size(); ++to) {
      for (std::size_t from = 0; from < decoders_.size(); ++from) {
        if (from == to || results[from].empty()) continue;
        EXPECT_TRUE(decoders_[to].takeResults(results[from]));
      }
    }
  }

  std::vector<Decoder> decoders_;
};

Bytes inChunks(const SampledField& field, const EncodeOptions& wanted = {}) {
  EncodeOptions options = wanted;
  options.chunkSide = 16;
  return encoded(field, options);
}

std::vector<SampledField> dividedFields() {
  const Size size{65, 49, 57};
  return {sampled("gyroid", size, gyroid(17)), sampled("sphere", size, sphere(size, 0.45))};
}

TEST(Shares, makeTheSurfaceOfOneDecoderOnEachLayer) {
  for (const auto& field : dividedFields()) {
    const Bytes bytes = inChunks(field);
    for (const int count : {1, 2, 3, 40}) {
      Shares shares(bytes, count);
      Decoder alone;
      alone.accept(bytes);
      alone.finish();
      while (alone.advance()) {
        ASSERT_TRUE(shares.advance());
        ASSERT_EQ(shares.first().bytes(), alone.bytes());
        const MeshOptions options{Polygonizer::Cubes, Frame::Grid, false};
        const Mesh whole = meshOf(alone, options), joined = shares.mesh(options);
        ASSERT_EQ(joined.indices, whole.indices);
        ASSERT_EQ(joined.positions.size(), whole.positions.size());
        // Estimates are rounded to units that depend on what is known around.
        EXPECT_LT(furthest(joined, whole, field.placement), 0.02);
      }
      ASSERT_TRUE(alone.isFinal() && shares.first().isFinal());
      EXPECT_FALSE(shares.advance());
      const MeshOptions cubes{Polygonizer::Cubes, Frame::World, true};
      EXPECT_EQ(shares.mesh(cubes).positions, meshOf(alone, cubes).positions);
    }
  }
}

TEST(Shares, ofLosslessTetrahedraToo) {
  const auto field = dividedFields()[0];
  EncodeOptions options;
  options.lossless = true;
  options.polygonizer = Polygonizer::Tetrahedra;
  const Bytes bytes = inChunks(field, options);
  Shares shares(bytes, 3);
  while (shares.advance()) {
  }
  const MeshOptions shown{Polygonizer::Tetrahedra, Frame::World, false};
  EXPECT_EQ(shares.mesh(shown).positions, decoded(bytes, shown).positions);
  EXPECT_EQ(shares.mesh(shown).indices, decoded(bytes, shown).indices);
}

TEST(Shares, ofAStreamWhoseIndexHasPagesToo) {
  const Bytes bytes = inChunks(sampled("gyroid", {129, 129, 145}, gyroid(41)));
  const MeshOptions shown{Polygonizer::Cubes, Frame::World, false};
  for (const std::optional<Region>& region :
       {std::optional<Region>(), {{{90, 90, 90}, {100, 100, 144}, Frame::Grid}}}) {
    Shares shares(bytes, 3, region);
    while (shares.advance()) {
    }
    ASSERT_TRUE(shares.first().isFinal());
    if (!region) {
      EXPECT_EQ(shares.mesh(shown).positions, decoded(bytes, shown).positions);
    }
    expectClosed(shares.mesh({Polygonizer::Cubes, Frame::Grid, false}), {129, 129, 145});
  }
}

TEST(Shares, ofARegionToo) {
  const auto field = dividedFields()[0];
  const Bytes bytes = inChunks(field);
  const Region region{{10, 10, 10}, {30, 30, 30}, Frame::Grid};
  Shares shares(bytes, 3, region);
  while (shares.advance()) {
  }
  Decoder alone;
  ASSERT_EQ(alone.setRegion(region), Error::None);
  alone.accept(bytes);
  while (alone.advance()) {
  }
  ASSERT_TRUE(shares.first().isFinal());
  const MeshOptions options{Polygonizer::Cubes, Frame::Grid, false};
  const Mesh whole = meshOf(alone, options), joined = shares.mesh(options);
  ASSERT_EQ(joined.positions.size(), whole.positions.size());
  expectClosed(joined, field.size);
}

TEST(Shares, ofOtherStreamsAreTheFirstOne) {
  const Size size{30, 30, 30};
  const Bytes bytes = encoded(sampled("sphere", size, sphere(size)));
  Shares shares(bytes, 2);
  while (shares.advance()) {
  }
  EXPECT_EQ(shares.mesh({}).positions, decoded(bytes).positions);
}

TEST(Shares, resultsOfOthersThatAreDamagedAreRefusedOrHarmless) {
  const auto field = dividedFields()[1];
  const Bytes bytes = inChunks(field);
  Decoder one, other;
  ASSERT_EQ(one.setShare({0, 2}), Error::None);
  ASSERT_EQ(other.setShare({1, 2}), Error::None);
  for (Decoder* decoder : {&one, &other}) {
    decoder->accept(bytes);
    while (decoder->advance()) {
    }
    ASSERT_TRUE(decoder->needsOthers());
  }
  const Bytes results = other.results();
  EXPECT_FALSE(one.takeResults({}));
  EXPECT_FALSE(one.takeResults(one.results()));
  EXPECT_FALSE(one.takeResults(std::span(results).first(results.size() / 2)));
  Bytes geometry = results;
  geometry[0] = std::byte{2};
  EXPECT_FALSE(one.takeResults(geometry));
}

TEST(Shares, anyResultsOfOthersAreHarmless) {
  const Size size{33, 33, 33};
  const Bytes bytes = inChunks(sampled("gyroid", size, gyroid(15)));
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i) {
    std::array<Decoder, 2> pair;
    for (int number = 0; number < 2; ++number) {
      ASSERT_EQ(pair[static_cast<std::size_t>(number)].setShare({number, 2}), Error::None);
      pair[static_cast<std::size_t>(number)].accept(bytes);
    }
    const auto give = [&](bool damaged) {
      Bytes results = pair[1].results();
      for (int flips = 0; damaged && flips < 3; ++flips)
        results[random() % results.size()] ^= static_cast<std::byte>(1 + random() % 255);
      const bool taken = pair[0].takeResults(results);
      return pair[1].takeResults(pair[0].results()) && taken;
    };
    for (bool going = true; going;) {
      going = false;
      for (Decoder& decoder : pair) going = decoder.advance() || going;
      if (pair[0].needsOthers()) going = give(i % 2 == 0);
    }
    if (pair[0].isFinal()) static_cast<void>(give(true));
    Mesh mesh;
    std::vector<MeshRun> runs;
    if (pair[0].mesh({}, mesh, runs) != Error::None) continue;
    for (const float coordinate : mesh.positions) ASSERT_TRUE(std::isfinite(coordinate));
  }
}

TEST(Shares, outOfRangeAreBadArguments) {
  for (const Share& share : {Share{0, 0}, Share{-1, 2}, Share{2, 2}, Share{0, -1}}) {
    Decoder decoder;
    EXPECT_EQ(decoder.setShare(share), Error::BadArgument);
  }
}

}  // namespace
}  // namespace isostar
