// Streams in chunks: the surfaces of streams without, whatever the order of work.
#include <numeric>
#include <thread>

#include "container/index.h"
#include "exact_crossings.h"
#include "surface_checks.h"

namespace isostar {
namespace {

EncodeOptions inChunks(int side) {
  EncodeOptions options;
  options.chunkSide = side;
  return options;
}

std::vector<SampledField> dividedFields() {
  std::vector<SampledField> fields;
  for (const Size& size : {Size{33, 34, 17}, Size{65, 40, 49}}) {
    for (auto& field : fieldsOf(size)) fields.push_back(std::move(field));
  }
  return fields;
}

/// Runs tasks from the last one to the first, each on a thread of its own.
void backwards(std::size_t count, const std::function<void(std::size_t)>& task) {
  for (std::size_t i = count; i-- > 0;) std::thread(task, i).join();
}
/// Runs all at once.
void together(std::size_t count, const std::function<void(std::size_t)>& task) {
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back(task, i);
  for (auto& thread : threads) thread.join();
}

Mesh decodedBy(const Bytes& bytes, const RunTasks& runTasks, const MeshOptions& options) {
  Decoder decoder({}, runTasks);
  decoder.accept(bytes);
  decoder.finish();
  while (decoder.advance()) {
  }
  EXPECT_EQ(decoder.error(), Error::None);
  EXPECT_TRUE(decoder.isFinal());
  return meshOf(decoder, options);
}

TEST(Chunks, holdTheBoundOfExactCrossings) {
  for (const auto& field : dividedFields()) {
    for (const double bound : {0.2, 0.01}) {
      EncodeOptions options = inChunks(16);
      options.maxError = bound;
      const Bytes bytes = encoded(field, options);
      ASSERT_GT(infoOf(bytes).layers.size(), 1u);
      EXPECT_LE(farthestFromExact(decoded(bytes, {Polygonizer::Cubes, Frame::Grid, false}), field),
                bound + 1e-4)
          << described(field);
    }
  }
}

TEST(Chunks, losslessSurfacesAreThoseOfTheSource) {
  for (const auto& field : dividedFields()) {
    for (const Polygonizer polygonizer : kPolygonizers) {
      EncodeOptions options = inChunks(32);
      options.lossless = true;
      options.polygonizer = polygonizer;
      const MeshOptions shown{polygonizer, Frame::Grid, true};
      SCOPED_TRACE(described(field));
      expectSameMesh(decoded(encoded(field, options), shown), sourceMesh(field, shown), 1e-4);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Chunks, bytesAndMeshesDoNotDependOnTheOrderOfWork) {
  for (const auto& field : dividedFields()) {
    EncodeOptions options = inChunks(16);
    const Bytes bytes = encoded(field, options);
    const MeshOptions shown{Polygonizer::Cubes, Frame::World, true};
    const Mesh mesh = decoded(bytes, shown);
    for (const RunTasks& runTasks : {RunTasks(backwards), RunTasks(together)}) {
      options.runTasks = runTasks;
      EXPECT_EQ(encoded(field, options), bytes) << described(field);
      const Mesh other = decodedBy(bytes, runTasks, shown);
      EXPECT_EQ(other.indices, mesh.indices);
      EXPECT_EQ(other.positions, mesh.positions);
      EXPECT_EQ(other.normals, mesh.normals);
    }
  }
}

TEST(Chunks, prefixesShowSoundClosedSurfaces) {
  for (const auto& field : fieldsOf({33, 34, 17})) {
    const Bytes bytes = encoded(field, inChunks(16));
    uint64_t before = 0;
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 30) {
      const Decoder decoder = decoderOf(std::span(bytes).first(length));
      ASSERT_EQ(decoder.error(), Error::Truncated);
      ASSERT_GE(decoder.bytes(), before);
      before = decoder.bytes();
      if (!decoder.ready()) continue;
      const Mesh mesh = meshOf(decoder, {Polygonizer::Tetrahedra, Frame::Grid, true});
      expectSound(mesh);
      expectClosed(mesh, field.size);
    }
  }
}

/// The lengths of prefixes that end with a chunk of signs or geometry, and of those that end within
/// the next one and so hold no more whole chunks.
std::vector<std::array<std::size_t, 2>> cutsAfterChunks(const Bytes& bytes) {
  Header header;
  std::size_t start = 0;
  EXPECT_EQ(read(bytes, header, start), Error::None);
  Index index;
  EXPECT_EQ(readIndex(bytes, start, header, UINT64_MAX, index), Error::None);
  std::vector<std::array<std::size_t, 2>> cuts;
  auto at = static_cast<std::size_t>(index.end);
  for (const LayerHead& head : index.heads) {
    bool isFirst = true;
    for (const uint64_t section : head.sections) {
      const std::size_t sum = checksumBytes(section);
      if (section > 1 && head.sections.size() > 1 && !isFirst) cuts.push_back({at, at + sum + 1});
      isFirst = isFirst && section == 0;
      at += sum + static_cast<std::size_t>(section);
    }
  }
  return cuts;
}

TEST(Chunks, prefixesThatEndWithAChunkShowTheOthersAsOnTheLevelBefore) {
  for (const auto& field : fieldsOf({33, 34, 17})) {
    const Bytes bytes = encoded(field, inChunks(16));
    for (const auto& [after, within] : cutsAfterChunks(bytes)) {
      const Decoder one = decoderOf(std::span(bytes).first(after)),
                    other = decoderOf(std::span(bytes).first(within));
      ASSERT_EQ(one.level(), other.level());
      if (one.level() + 1 == one.levels()) break;  // parts of geometry are shown as they arrive
      EXPECT_EQ(meshOf(one).positions, meshOf(other).positions) << after << described(field);
    }
  }
}

TEST(Chunks, smallSurfacesHaveNone) {
  const Size size{40, 40, 40};
  const auto field = sampled("sphere", size, sphere(size));
  EXPECT_EQ(encoded(field), encoded(field, inChunks(0)));
}

TEST(Chunks, sidesThatAreNoPowersOfTwoAreBadArguments) {
  const auto field = sampled("sphere", {40, 40, 40}, sphere({40, 40, 40}));
  for (const int side : {1, 8, 24, 100, -2}) {
    Bytes bytes;
    EXPECT_EQ(encode(field.volume(), inChunks(side), bytes), Error::BadArgument) << side;
  }
}

}  // namespace
}  // namespace isostar
