// Streams that are encoded and decoded by several threads.
#include <gtest/gtest.h>

#include "sampled_field.h"
#include "threads/parallel_tasks.h"

namespace isostar {
namespace {

/// A surface in most bricks of a grid that makes several chunks and pieces.
SampledField wavy() {
  return sampled("gyroid", {65, 50, 49}, gyroid(28));
}

std::vector<std::byte> encodedBy(const RunTasks& runTasks, const SampledField& field,
                                 EncodeOptions options) {
  options.chunkSide = 32;
  options.runTasks = runTasks;
  std::vector<std::byte> bytes;
  EXPECT_EQ(encode(field.volume(), options, bytes), Error::None);
  return bytes;
}

/// The surface after each layer.
std::vector<Mesh> decodedBy(const RunTasks& runTasks, const std::vector<std::byte>& bytes) {
  Decoder decoder({}, runTasks);
  decoder.accept(bytes);
  decoder.finish();
  std::vector<Mesh> meshes;
  while (decoder.advance()) {
    meshes.emplace_back();
    EXPECT_EQ(decoder.mesh({}, meshes.back()), Error::None);
  }
  EXPECT_EQ(decoder.error(), Error::None);
  EXPECT_TRUE(decoder.isFinal());
  return meshes;
}

class StreamsInThreads : public testing::Test {
 protected:
  void SetUp() override { useThreads(4); }
  void TearDown() override { useThreads(0); }
};

TEST_F(StreamsInThreads, areThoseOfOneThread) {
  const SampledField field = wavy();
  EncodeOptions options, lossless;
  lossless.lossless = true;
  lossless.polygonizer = Polygonizer::Tetrahedra;
  for (const EncodeOptions& each : {options, lossless}) {
    const auto bytes = encodedBy({}, field, each);
    EXPECT_EQ(encodedBy(parallelTasks(), field, each), bytes);
    const auto meshes = decodedBy({}, bytes), others = decodedBy(parallelTasks(), bytes);
    ASSERT_EQ(others.size(), meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      EXPECT_EQ(others[i].positions, meshes[i].positions);
      EXPECT_EQ(others[i].normals, meshes[i].normals);
      EXPECT_EQ(others[i].indices, meshes[i].indices);
    }
  }
}

}  // namespace
}  // namespace isostar
