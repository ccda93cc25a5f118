// What a stream says of itself, for callers.
#pragma once

#include <algorithm>

#include "decoder/stream_heads.h"
#include "util/cold_path.h"

namespace isostar {

[[nodiscard]] ISOSTAR_COLD inline StreamInfo describeHeader(const StreamHeads& heads) {
  const Header& h = heads.header();
  StreamInfo info;
  info.version = h.version;
  info.dimension = h.dimension;
  std::copy_n(h.size.begin(), 3, info.size.begin());
  info.frames = h.size[3];
  info.placement = h.placement;
  info.isovalues.push_back(h.isovalue);
  for (const double other : h.furtherIsovalues) info.isovalues.push_back(other);
  info.polygonizer = h.polygonizer;
  info.lossless = h.lossless;
  info.adaptive = h.adaptive;
  info.preservesTopology = h.keepsTopology;
  info.effort = h.fitted ? 2 : 1;
  info.trimmed = h.trimmed;
  info.chunkSide = h.chunkSide;
  info.maxError = h.lossless ? 0 : h.maxError;
  info.vertices = h.vertices;
  info.headerBytes = heads.start();
  info.bytes = heads.end();
  return info;
}

/// Adds a layer whose own bytes begin at `start`. `headBytes`: of its head, if it has one in front.
ISOSTAR_COLD inline void addLayer(StreamInfo& info, const Header& header, const LayerHead& head,
                                  std::size_t headBytes, std::size_t start) {
  const bool further = traitsOf(head.kind).isFurther;
  info.headerBytes += headBytes;
  info.layers.push_back({traitsOf(head.kind).name, further ? header.finestLevel() : head.level,
                         start + head.bytes, head.bytes, head.error, further ? head.level : 0});
}

}  // namespace isostar
