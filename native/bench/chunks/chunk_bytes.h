// What it costs to code a stream in chunks that are independent of each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace isostar::bench {

/// Where the bit models of a chunk start.
enum class ModelStart {
  Continued,  // where the chunk before left them: one run of decisions, for comparison only
  Coarse,     // at their state after the last level that is one chunk
  Initial     // as at the start of a stream
};

struct ChunkOptions {
  int32_t side = 128;  // of a chunk, in cells of its level
  ModelStart models = ModelStart::Coarse;
  bool seesScalars = false;  // do contexts see the neighbours' displacements and scalars?
};

struct ChunkBytes {
  std::size_t layers = 0;    // coded bytes, without heads
  std::size_t sections = 0;  // pairs of a layer and a chunk with anything in it
  uint64_t differing = 0;    // vertices whose interval is not that of the whole stream
};

/// Codes the layers of a volume's uniform stream anew, in chunks. Levels of a single chunk stay as
/// they are. Throws a Failure if the stream is not a uniform one of a volume, or not sound.
[[nodiscard]] ChunkBytes chunkBytes(std::span<const std::byte> stream, const ChunkOptions&);

/// The share of the surface's vertices whose edge lies in a plane between two chunks of the finest
/// level: what chunks that code their last planes as well code twice.
[[nodiscard]] double sharedVertices(std::span<const std::byte> stream, int32_t side);

}  // namespace isostar::bench
