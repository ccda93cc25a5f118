#pragma once

#include <cstddef>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::bench {

struct MeshoptStream {
  size_t bytes = 0;
  Mesh decoded;
};

/// What gltfpack -cc makes, then zstd: positions in `bits` of the box's longest side,
/// meshoptimizer's vertex and index codecs in the order that suits them.
MeshoptStream encodeMeshopt(const Mesh&, int bits);

/// The volume itself under zstd, in the narrowest type that holds its samples.
size_t zstdBytes(const std::vector<float>& samples);

}  // namespace isostar::bench
