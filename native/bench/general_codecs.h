#pragma once

#include <cstddef>
#include <vector>

#include "isostar/isostar.h"

namespace isostar::bench {

struct MeshoptStream {
  size_t bytes = 0;
  Mesh decoded;
};

/// The output of `gltfpack -cc`, compressed by zstd: positions quantized to `bits` of the bounding
/// box's longest side, then meshoptimizer's vertex and index codecs on vertices in the order that
/// suits them.
MeshoptStream encodeMeshopt(const Mesh&, int bits);

/// The size of the volume compressed by zstd, in the narrowest type that holds its samples.
size_t zstdBytes(const std::vector<float>& samples);

}  // namespace isostar::bench
