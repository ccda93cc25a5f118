// What a decoder spends on a stream: memory by allocations, time by the processor's clock.
#pragma once

#include <ctime>

#include "allocation.h"
#include "property/round_trip.h"

namespace isostar {

struct Cost {
  std::size_t bytes = 0, layers = 0;
  std::size_t peak = 0;              // bytes
  double decoding = 0, showing = 0;  // seconds: all layers; the slower of both last surfaces
  uint64_t vertices = 0;
  Error error = Error::None;
};

inline double processorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Decodes all layers, then makes the surface with both polygonizers.
inline Cost costOf(const Bytes& bytes, const Limits& limits) {
  Cost cost;
  const Allocation allocation;
  Decoder decoder(limits);
  const double start = processorSeconds();
  decoder.accept(bytes);
  decoder.finish();
  while (decoder.advance()) ++cost.layers;
  cost.decoding = processorSeconds() - start;
  cost.error = decoder.error();
  for (const Polygonizer polygonizer : kPolygonizers) {
    MeshOptions options{polygonizer, Frame::World, true};
    Mesh mesh;
    Contours contours;
    const double before = processorSeconds();
    if (decoder.info().dimension == 2)
      (void)decoder.contours(options, contours);
    else
      (void)decoder.mesh(options, mesh);
    cost.showing = std::max(cost.showing, processorSeconds() - before);
    cost.vertices = std::max<uint64_t>(cost.vertices, mesh.positions.size() / 3);
  }
  cost.bytes = bytes.size();
  cost.peak = allocation.peak();
  return cost;
}

}  // namespace isostar
